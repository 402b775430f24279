#!/usr/bin/env bash
# style.sh [format|rooms|python]... - what every file is held to by `./dev lint` and by the tests style.*;
# all three where none is named. Installs nothing: what is missing is a fault.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/dev/setup.sh
source tools/dev/format.sh

rooms() {
  python3 tools/dev/floors.py
}

python() {
  command -v pyflakes3 >/dev/null || die "pyflakes3 is missing: apt-get install pyflakes3"
  find . -name '*.py' -not -path './.roots/*' -not -path './build/*' -not -path './out/*' -print0 | xargs -0r pyflakes3
}

if [[ $# == 0 ]]; then set -- format rooms python; fi
status=0
for check in "$@"; do
  case $check in
    format) check_format || status=1 ;;
    rooms | python) "$check" || status=1 ;;
    *) die "style.sh knows format, rooms and python, not $check" ;;
  esac
done
exit $status
