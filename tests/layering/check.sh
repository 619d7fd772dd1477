#!/usr/bin/env bash
# Holds the sources to the arrows of rules.txt, and to the size and opening lines of house style.
#   check.sh ROOT    prints every breach as file:line: sentence; fails when there is one
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
cd "${1:?usage: check.sh ROOT}"

mapfile -t sources < <(find app core ui \( -name '*.h' -o -name '*.cpp' \) -type f | sort)
mapfile -t tests < <(find tests -name '*.h' -type f -o -name '*.cpp' -type f | sort)
mapfile -t lists < <(find app core ui -name CMakeLists.txt -type f | sort)
(( ${#sources[@]} > 0 )) || { echo "no sources under $PWD"; exit 1; }

breaches=$(
  awk -f "$here/arrows.awk" "$here/rules.txt" "${sources[@]}" "${lists[@]}"
  awk -f "$here/openings.awk" "${sources[@]}" "${tests[@]}"
)
if [[ -n $breaches ]]; then
  printf '%s\n' "$breaches"
  echo "$(wc -l <<<"$breaches") breaches; the rules are in tests/layering/rules.txt"
  exit 1
fi
echo "${#sources[@]} sources and ${#lists[@]} link lists keep the arrows"
