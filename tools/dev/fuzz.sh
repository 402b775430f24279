# fuzz.sh - broken scene files for the reader of .rnmscene. Sourced by ./dev.

fuzz() {
  local seconds=${1:-600} folder=build/fuzz
  require "${build_packages[@]}" clang libclang-rt-14-dev
  local launcher=
  if command -v ccache >/dev/null; then launcher=ccache; fi
  cmake -G Ninja -S . -B "$folder" -DRNMBAKE_FUZZ=ON -DRNMBAKE_TESTS=OFF -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" \
    >"$(log fuzz-configure)" 2>&1 || die "the configuration failed: $(tail -n 20 "$(log fuzz-configure)")"
  cmake --build "$folder" --target exchange_fuzz exchange_seeds
  mkdir -p "$folder/corpus" "$folder/findings"
  "$folder/exchange_seeds" "$folder/seeds"
  echo "fuzz: $seconds seconds; what breaks the reader goes to $folder/findings" >&2
  "$folder/exchange_fuzz" "$folder/corpus" "$folder/seeds" -dict=tests/fuzz/exchange.dict -max_len=16384 \
    -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=256 -max_total_time="$seconds" -print_final_stats=1 \
    -artifact_prefix="$folder/findings/" >"$(log fuzz)" 2>&1 ||
    die "the reader broke: $(grep -m 1 -E 'ERROR|SUMMARY' "$(log fuzz)"), see $(log fuzz)"
  grep -E '^(Done|stat::)' "$(log fuzz)"
}
