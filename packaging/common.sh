# What the scripts of this repository share. Sourced, never run.
# SPDX-License-Identifier: GPL-3.0-or-later

gyre_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '==> %s\n' "$*"; }

# fail WHAT_HAPPENED WHAT_TO_TRY
fail() {
  printf 'gyre: %s\n      %s\n' "$1" "$2" >&2
  exit 1
}

# The largest file (a CGAL algorithm) takes 2.3 GB in the compiler: as many jobs as fit, at least one.
buildJobs() {
  local cores available_kb by_memory
  cores=$(nproc)
  available_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  by_memory=$(( available_kb / 2400000 ))
  (( by_memory < 1 )) && by_memory=1
  echo $(( cores < by_memory ? cores : by_memory ))
}

# Where ccache compiles it hits across checkouts, and with precompiled headers.
export CCACHE_BASEDIR=$gyre_root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros

# configure PRESET [cmake options...]: quiet when all is well, whole when it fails.
configure() {
  local preset=$1 log
  shift
  log=$(mktemp)
  if command -v ccache >/dev/null && [[ -z ${CMAKE_CXX_COMPILER_LAUNCHER:-} ]]; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_C_COMPILER_LAUNCHER=ccache
  fi
  if ! (cd "$gyre_root" && cmake --preset "$preset" "$@") >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    fail "CMake could not configure the build." \
      "Read the first error above; delete build/$preset and try again if it speaks of an old cache."
  fi
  rm -f "$log"
}
