#!/usr/bin/env bash
# The check itself is checked: a clean tree passes, and each planted breach is found where it stands.
#   check_test.sh    fails with a sentence at the first surprise
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/check.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
spdx='// SPDX-License-Identifier: GPL-3.0-or-later'

# put FILE LINE...: a source with the given lines after its opening.
put() {
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "// What it is for." "$spdx" "${@:2}" >"$tree/$1"
}

cleanTree() {
  rm -rf "${tree:?}"/*
  mkdir -p "$tree/tests"
  put core/base/task.h '#include <vector>'
  put core/scan/frame.h '#include <opencv2/core/mat.hpp>' '#include "core/geometry/ray.h"'
  put core/geometry/ray.h '#include <Eigen/Core>' '#include "core/base/task.h"'
  put core/mesh/options.h '#include "core/base/task.h"'
  put core/mesh/alpha.cpp '#include <CGAL/Delaunay_3.h>' '#include "core/scan/frame.h"'
  put core/calib/match/find.cpp '#include "core/calib/corners/ring.h"' '#include "core/scan/frame.h"'
  put core/sim/camera.cpp '#include "core/device/camera.h"'
  put core/pipeline/run.cpp '#include "core/mesh/options.h"' '#include "core/sim/camera.h"'
  put ui/panel.h '#include <QWidget>' '#include "core/scan/frame.h"' '#include "core/mesh/options.h"'
  put app/main.cpp '#include "ui/panel.h"' '#include "core/pipeline/run.h"'
  mkdir -p "$tree/core/mesh"
  printf '%s\n' 'target_link_libraries(gyre_mesh' '  PUBLIC gyre::scan # not gyre::sim' '  PRIVATE gyre::strict)' \
    >"$tree/core/mesh/CMakeLists.txt"
}

cleanTree
"$check" "$tree" >/dev/null || { echo "a clean tree was refused:"; "$check" "$tree"; exit 1; }

# finds PLACE: the check must fail and name the place.
finds() {
  local said
  if said=$("$check" "$tree"); then
    echo "the breach at $1 was not found"
    exit 1
  fi
  grep -q "^$1: " <<<"$said" || { echo "the breach at $1 was named otherwise: $said"; exit 1; }
  [[ $(grep -c '^[a-z].*:[0-9]*: ' <<<"$said") == 1 ]] || { echo "more than one breach: $said"; exit 1; }
  cleanTree
}

put core/base/bad.h '#include "core/scan/frame.h"';           finds core/base/bad.h:3
put core/geometry/bad.cpp '' '# include "core/scan/frame.h"'; finds core/geometry/bad.cpp:4
put core/mesh/bad.cpp '#include "core/sim/camera.h"';         finds core/mesh/bad.cpp:3
put core/device/bad.cpp '#include "core/sim/camera.h"';       finds core/device/bad.cpp:3
put core/recover/bad.cpp '#include "core/track/klt.h"';       finds core/recover/bad.cpp:3
put core/io/bad.cpp '#include "app/settings.h"';              finds core/io/bad.cpp:3
put core/pipeline/bad.cpp '#include "ui/panel.h"';            finds core/pipeline/bad.cpp:3
put core/mesh/bad.h '#include <CGAL/Delaunay_3.h>';           finds core/mesh/bad.h:3
put core/scan/bad.h '#include <opencv2/core/mat.hpp>';        finds core/scan/bad.h:3
put core/scan/bad.cpp '#include <opencv2/highgui.hpp>';       finds core/scan/bad.cpp:3
put core/io/bad.h '#include <nlohmann/json.hpp>';             finds core/io/bad.h:3
put core/io/bad.cpp '#include <QString>';                     finds core/io/bad.cpp:3
put core/mesh/bad.cpp '#include <vtkPolyData.h>';             finds core/mesh/bad.cpp:3
put core/mesh/bad.cpp '#include "alpha.h"';                   finds core/mesh/bad.cpp:3
put core/attic/bad.cpp '#include "core/base/task.h"';         finds core/attic/bad.cpp:3
put core/calib/lens/bad.cpp '#include "core/calib/rig/turn.h"'; finds core/calib/lens/bad.cpp:3
put ui/bad.cpp '#include "core/mesh/alpha.h"';                finds ui/bad.cpp:3
put ui/bad.cpp '#include "app/settings.h"';                   finds ui/bad.cpp:3
put ui/bad.cpp '#include <thread>';                           finds ui/bad.cpp:3
echo 'target_link_libraries(gyre_mesh PRIVATE gyre::sim)' >"$tree/core/mesh/CMakeLists.txt"
finds core/mesh/CMakeLists.txt:1
printf '%s\n' 'target_link_libraries(gyre_mesh' 'PRIVATE Qt6::Core)' >"$tree/core/mesh/CMakeLists.txt"
finds core/mesh/CMakeLists.txt:2
echo 'target_link_libraries(gyre_app ${OpenCV_LIBS})' >"$tree/app/CMakeLists.txt"
finds app/CMakeLists.txt:1
printf '%s\n' '// What it is for.' '#include <vector>' >"$tree/ui/bad.h"; finds ui/bad.h:1
printf '%s\n' "$spdx" '#include <vector>' >"$tree/ui/bad.h";              finds ui/bad.h:1
{ echo "$spdx"; printf '// line %d\n' {1..400}; } >"$tree/ui/bad.cpp";       finds ui/bad.cpp:400
echo "every planted breach was found"
