# fuzz.sh - broken scene files, pictures, project files and results of launches for their readers. Sourced by ./dev.

fuzz() {
  local target=exchange
  case "${1:-}" in exchange | ssbump | project | launch) target=$1 && shift ;; esac
  local seconds=${1:-600} folder=build/fuzz allocation=256
  [[ $target == ssbump ]] && allocation=2048 # the system's readers believe what a header promises
  require "${build_packages[@]}" clang libclang-rt-14-dev
  local launcher=
  if command -v ccache >/dev/null; then launcher=ccache; fi
  cmake -G Ninja -S . -B "$folder" -DRNMBAKE_FUZZ=ON -DRNMBAKE_TESTS=OFF -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" \
    >"$(log fuzz-configure)" 2>&1 || die "the configuration failed: $(tail -n 20 "$(log fuzz-configure)")"
  cmake --build "$folder" --target "${target}_fuzz" "${target}_seeds"
  local work=$folder/$target
  mkdir -p "$work/corpus" "$work/findings"
  "$folder/${target}_seeds" "$work/seeds"
  echo "fuzz: $seconds seconds; what breaks $target goes to $work/findings" >&2
  "$folder/${target}_fuzz" "$work/corpus" "$work/seeds" -dict="tests/fuzz/$target.dict" -max_len=16384 \
    -timeout=10 -rss_limit_mb=$((allocation * 4)) -malloc_limit_mb="$allocation" -max_total_time="$seconds" -print_final_stats=1 \
    -artifact_prefix="$work/findings/" >"$(log fuzz)" 2>&1 ||
    die "$target broke: $(grep -m 1 -E 'ERROR|SUMMARY' "$(log fuzz)"), see $(log fuzz)"
  grep -E '^(Done|stat::)' "$(log fuzz)"
}
