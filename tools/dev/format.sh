# format.sh - the committed C++ style (.clang-format). Sourced by ./dev and style.sh.

cpp_files() {
  find src tests bench -name '*.h' -o -name '*.cpp' | sort
}

# clang-format of the one version that the committed style is of: each breaks lines a little differently.
clang_format() {
  local version=14 program
  for program in clang-format-$version clang-format; do
    if command -v "$program" >/dev/null && [[ $("$program" --version) == *"version $version."* ]]; then
      echo "$program"
      return
    fi
  done
  die "clang-format $version is missing: apt-get install clang-format (Debian 12) or clang-format-$version"
}

check_format() {
  local program
  program=$(clang_format) || return
  cpp_files | xargs -r "$program" --dry-run --Werror
}

format() {
  require "${style_packages[@]}"
  local program
  program=$(clang_format)
  case ${1:-} in
    "") cpp_files | xargs -r "$program" -i ;;
    --check) check_format ;;
    *) die "./dev format knows --check, not $1" ;;
  esac
}
