"""A picture of a report, as headless Chromium shows it.

    report_picture.py REPORT.html PICTURE.png [--width 1000] [--height 1000] [--open KEY] [--dark] [--phone]
"""
import argparse
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "report"))
import browser  # noqa: E402


def open_object(tab, key):
    """Unfolds the object's maps."""
    tab.run(f"""(key => {{
        const row = [...document.querySelectorAll('.objects > tbody > tr')].find(
            one => one.querySelector('.key')?.firstChild.textContent === key);
        row.querySelector('button.open').click();
    }})({key!r})""")
    tab.wait("document.querySelector('.detail .viewer') !== null")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--width", type=int, default=1000)
    parser.add_argument("--height", type=int, default=1000, help="0: all of the page")
    parser.add_argument("--open", metavar="KEY", help="object whose maps are unfolded")
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--phone", action="store_true")
    args = parser.parse_args()
    if not browser.find():
        sys.exit("report_picture.py: no Chromium; install the package chromium")
    tab = browser.Browser()
    try:
        scheme = "dark" if args.dark else "light"
        tab.look_like(args.width, args.height or 900, scheme, args.phone)
        tab.open(args.report)
        if args.open:
            open_object(tab, args.open)
        if not args.height:  # a window as long as the page: pictures are drawn once they come into sight
            tab.look_like(args.width, tab.run("document.documentElement.scrollHeight"), scheme, args.phone)
        tab.run("new Promise(done => setTimeout(done, 500))")
        tab.screenshot(args.picture, whole=False)
    finally:
        tab.close()
    for problem in tab.problems:
        print(f"report_picture.py: {problem}", file=sys.stderr)
    return 1 if tab.problems else 0


if __name__ == "__main__":
    sys.exit(main())
