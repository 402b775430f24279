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
  require "${build_packages[@]}" "${style_packages[@]}" clang-tidy
  local status=0
  tools/dev/style.sh || status=1
  build release # clang-tidy reads its compile commands, and the sources that it generates
  tidy_files "$@" | xargs -r -n 4 -P "$(nproc)" \
    clang-tidy -p build/release --quiet --warnings-as-errors='*' 2>"$(log tidy)" || status=1
  if [[ $status == 0 ]]; then echo "lint: clean"; else die "lint found something, see above"; fi
}
