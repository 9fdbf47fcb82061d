#!/bin/sh
# Build the preset "fuzz" and run each target: tests/fuzz/run.sh SECONDS [TARGET...]
# One summary line a target; exit status 1 when any of them found something (its input is kept beside the corpus).
set -eu
if [ $# -lt 1 ]; then
  echo "usage: $0 SECONDS [ptf|run|record|obj|ply|gltf|triangulate]..." >&2
  exit 2
fi
seconds=$1
shift
[ $# -gt 0 ] || set -- ptf run record obj ply gltf triangulate
cd "$(dirname "$0")/../.."
build=${HALFSPACE_FUZZ_BUILD:-build/fuzz}
work=$build/corpus
if [ "$build" = build/fuzz ]; then
  cmake --preset fuzz >/dev/null
  cmake --build --preset fuzz -j "${JOBS:-2}" >/dev/null
fi
python3 tests/fuzz/make_seeds.py "$work/seeds"
status=0
for target in "$@"; do
  mkdir -p "$work/$target" "$work/found"
  log=$work/$target.log
  result=clean
  seeds=$target
  [ "$target" != run ] || seeds=ptf  # frames again
  "$(find "$build" -name "fuzz_$target" -type f)" "$work/$target" "$work/seeds/$seeds" \
    -max_total_time="$seconds" -max_len=4096 -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$work/found/$target-" >"$log" 2>&1 || result="FOUND SOMETHING, see $log"
  [ "$result" = clean ] || status=1
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  peak=$(sed -n 's/^stat::peak_rss_mb: *//p' "$log")
  echo "fuzz_$target: ${runs:-?} runs in $seconds s, peak ${peak:-?} MB: $result"
done
exit $status
