# lint.sh - what a reviewer should not have to say. Sourced by ./dev.
source tools/dev/format.sh

# Those of the C++ sources that differ from the main branch, or all of them.
tidy_files() {
  if [[ ${1:-} == --changed ]]; then
    { git diff --name-only --diff-filter=d main; git ls-files --others --exclude-standard; } |
      grep -E '^(src|tests|bench)/.*\.cpp$' | sort -u || true
  else
    cpp_files | grep '\.cpp$'
  fi
}

lint() {
  case ${1:-} in "" | --changed) ;; *) die "./dev lint knows --changed, not $1" ;; esac
  require "${build_packages[@]}" clang-format clang-tidy python3 pyflakes3
  local status=0
  format --check || status=1
  python3 tools/dev/floors.py || status=1
  find . -name '*.py' -not -path './.roots/*' -not -path './build/*' -print0 | xargs -0r pyflakes3 || status=1
  build release # clang-tidy reads its compile commands, and the sources that it generates
  tidy_files "$@" | xargs -r -n 4 -P "$(nproc)" \
    clang-tidy -p build/release --quiet --warnings-as-errors='*' 2>"$(log tidy)" || status=1
  if [[ $status == 0 ]]; then echo "lint: clean"; else die "lint found something, see above"; fi
}
