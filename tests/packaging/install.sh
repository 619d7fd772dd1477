#!/usr/bin/env bash
# Installs a built tree into a folder of its own and looks whether everything is there and starts.
#   install.sh BUILD_FOLDER
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
build=${1:?usage: install.sh BUILD_FOLDER}
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT

cmake --install "$build" --prefix "$prefix" >/dev/null
for file in bin/gyre share/applications/gyre.desktop share/metainfo/org.gyre_scan.Gyre.metainfo.xml \
  share/icons/hicolor/scalable/apps/gyre.svg share/man/man1/gyre.1 lib/udev/rules.d/70-gyre.rules \
  share/gyre/turntables/workshop.json; do
  [[ -s $prefix/$file ]] || { echo "$file was not installed"; exit 1; }
done
strays=$(find "$prefix" -name '*.a' -o -name '*.h' -o -name '*_test')
[[ -z $strays ]] || { echo "these do not belong in an installation: $strays"; exit 1; }
"$prefix/bin/gyre" --version
