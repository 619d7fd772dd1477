# Tells what Open3D reads in each of these files: one line of JSON a file.
# SPDX-License-Identifier: GPL-3.0-or-later
import json
import sys

import numpy
import open3d

for path in sys.argv[1:]:
    mesh = open3d.io.read_triangle_mesh(path)
    mesh.remove_duplicated_vertices()  # STL has three corners of its own for each triangle
    box = mesh.get_axis_aligned_bounding_box()
    colours = numpy.asarray(mesh.vertex_colors)
    print(json.dumps({
        "min": list(box.min_bound),
        "max": list(box.max_bound),
        "triangles": len(mesh.triangles),
        "watertight": mesh.is_watertight(),
        "volume": mesh.get_volume() if mesh.is_watertight() else 0.0,
        "colours": sorted({tuple(round(255 * c) for c in colour) for colour in colours.tolist()}),
    }))
