"""The pages of docs/ that hold measured figures between two marks."""
import re

from measure import ROOT

BEGIN, END = "<!-- figures: begin -->\n", "<!-- figures: end -->"


def renew(document, figures, part="figures"):
    """Puts the figures into a page of docs/ in place of those that it has; `part` names the marks."""
    begin, end = BEGIN.replace("figures", part), END.replace("figures", part)
    old = document.read_text(encoding="utf-8")
    new, found = re.subn(f"{begin}.*{end}", lambda _: begin + figures + end, old, flags=re.DOTALL)
    if found != 1:
        raise SystemExit(f"{document} has no place for the figures")
    document.write_text(new, encoding="utf-8")
    print(f"wrote {document.relative_to(ROOT)}")
