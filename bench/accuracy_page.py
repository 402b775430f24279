"""docs/accuracy.md: a part about scenes and one about closed forms, each of which can be renewed alone."""
import re

import scene_tables
from measure import ROOT, say

DOCUMENT = ROOT / "docs/accuracy.md"
INTRODUCTION = """# Accuracy

Written by `./dev accuracy`; do not edit. Two parts: [scenes](#scenes), in which bakes are held against our own
[reference tracer](reference.md), and [closed forms](#closed-forms), in which the answer is a formula.
"""


def write(results, scenes, closed_forms=None):
    """Renews the scenes, and the closed forms where a file has their text."""
    old = DOCUMENT.read_text(encoding="utf-8") if DOCUMENT.exists() else ""
    kept = closed_forms.read_text(encoding="utf-8") if closed_forms else part(old, "closed forms")
    text = "\n".join([INTRODUCTION, marked("scenes", scene_tables.text(results, scenes)), marked("closed forms", kept)])
    DOCUMENT.write_text(text, encoding="utf-8")
    say(f"wrote {DOCUMENT.relative_to(ROOT)}")


def marked(name, text):
    return f"<!-- {name}: begin -->\n{text.strip()}\n<!-- {name}: end -->\n"


def part(document, name):
    found = re.search(f"<!-- {name}: begin -->\n(.*)<!-- {name}: end -->", document, flags=re.DOTALL)
    return found[1] if found else "## Closed forms\n\nNot measured yet.\n"
