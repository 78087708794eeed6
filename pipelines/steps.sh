# Sourced by the pipelines: numbered steps with their times, the shared set-up and build.
# The pipeline sets step_count, and dry_run=1 to have its steps only said.
set -euo pipefail
: "${step_count:=0}"
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
pipeline=$(basename "$0")
dry_run=${dry_run:-}
step_index=0
pipeline_begin=$(date +%s)

stop() { printf '%s: %s\n' "$pipeline" "$2" >&2; exit "$1"; }

# step WHAT COMMAND...: says what, runs the command, says how long it took. The pipeline ends where a step fails.
step() {
  local what=$1 begin status=0
  shift
  step_index=$((step_index + 1))
  printf '== %d/%d %s\n' "$step_index" "$step_count" "$what"
  if [ -n "$dry_run" ]; then return 0; fi
  begin=$(date +%s)
  # Not tested by `||`: that would switch off errexit inside the command when it is a function.
  set +e
  (set -e; "$@") </dev/null
  status=$?
  set -e
  if [ "$status" != 0 ]; then
    printf '== %d/%d failed with exit code %d after %d s: %s\n' \
      "$step_index" "$step_count" "$status" "$(($(date +%s) - begin))" "$what" >&2
    exit "$status"
  fi
  printf '   %d s\n' "$(($(date +%s) - begin))"
}

finished() {
  if [ -n "$dry_run" ]; then return 0; fi
  printf '== %s: done in %d s\n' "$pipeline" "$(($(date +%s) - pipeline_begin))"
}

# configure PRESET [OPTION...]
configure() {
  local preset=$1 launcher=()
  shift
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  cmake --preset "$preset" --log-level=WARNING "${launcher[@]}" "$@" >/dev/null
}

# compile PRESET [TARGET...]: says only what goes wrong, unless a person looks on.
compile() {
  local preset=$1 quiet=(--quiet)
  shift
  if [ -t 1 ]; then quiet=(); fi
  cmake --build --preset "$preset" --parallel "$(jobs_at_once)" ${1+--target "$@"} -- "${quiet[@]}"
}

# As many compilers as there are processors, and no more than fit into memory at 1.5 GB each.
jobs_at_once() {
  local processors fitting
  processors=$(nproc)
  fitting=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
  if [ "$fitting" -lt 1 ]; then fitting=1; fi
  if [ "$fitting" -lt "$processors" ]; then echo "$fitting"; else echo "$processors"; fi
}
