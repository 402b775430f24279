# format.sh - the committed C++ style (.clang-format, version 14). Sourced by ./dev.

cpp_files() {
  find src tests bench -name '*.h' -o -name '*.cpp' | sort
}

format() {
  require clang-format
  case ${1:-} in
    "") cpp_files | xargs -r clang-format -i ;;
    --check) cpp_files | xargs -r clang-format --dry-run --Werror ;;
    *) die "./dev format knows --check, not $1" ;;
  esac
}
