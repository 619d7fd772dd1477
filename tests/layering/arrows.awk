# Reads rules.txt, then sources and CMakeLists.txt; prints each include or link against the arrows.
# SPDX-License-Identifier: GPL-3.0-or-later

# The room of a path: "core/mesh" of core/mesh/wrap.cpp, "ui" of ui/pages/start.h.
function roomOf(path, parts) {
  split(path, parts, "/")
  return parts[1] == "core" ? parts[1] "/" parts[2] : parts[1]
}

# The folder of a path within its room: "core/calib/rig" of core/calib/rig/turn.h, nothing of
# core/calib/turn.h. Only folders that the rules name are held apart.
function cornerOf(path, parts, corner) {
  if (split(path, parts, "/") < 4) return ""
  corner = parts[1] "/" parts[2] "/" parts[3]
  return corner in arrows ? corner : ""
}

# Whether a file may see a header of its own room.
function maySeeInside(file, header, from, to) {
  from = cornerOf(file)
  to = cornerOf(header)
  return from == "" || to == "" || from == to || index(" " arrows[from] " ", " " to " ") > 0
}

# Whether the file stands in one of the places, "core", "core/scan/frame.h" or "core:cpp".
function standsIn(file, places, list, count, i, place) {
  count = split(places, list, " ")
  for (i = 1; i <= count; i++) {
    place = list[i]
    if (sub(/:cpp$/, "", place) && file !~ /\.cpp$/) continue
    if (file == place || index(file, place "/") == 1) return 1
  }
  return 0
}

# Whether a room may see a path ("core/scan/mesh.h") or another room ("core/scan").
function maySee(room, path, list, count, i, target) {
  target = roomOf(path)
  if (target == room) return 1
  count = split(arrows[room], list, " ")
  for (i = 1; i <= count; i++) {
    if (list[i] == target || (list[i] == "core/*" && target ~ /^core\//)) return 1
    if (list[i] == "core/*/options.h" && path ~ /^core\/.*\/options\.h$/) return 1
  }
  return 0
}

function breach(sentence) { printf "%s:%d: %s\n", FILENAME, FNR, sentence }

function checkForeign(header, i) {
  for (i = 1; i <= foreign_count; i++) {
    if (header ~ foreign_pattern[i]) {
      if (!standsIn(FILENAME, foreign_places[i]))
        breach("<" header "> may stand only in: " (foreign_places[i] == "" ? "nothing" : foreign_places[i]))
      return
    }
  }
}

# One word of target_link_libraries(target word...).
function checkLink(word, i) {
  if (word ~ /^gyre(::|_)/) {
    sub(/^gyre(::|_)/, "", word)
    if (word == "strict" || word == "options") return
    path = word == "ui" || word == "app" ? word : "core/" word
    if (!(roomOf(FILENAME) in arrows) || !maySee(roomOf(FILENAME), path))
      breach(roomOf(FILENAME) " may not link " path)
    return
  }
  for (i = 1; i <= link_count; i++)
    if (word ~ link_pattern[i] && !standsIn(FILENAME, link_places[i]))
      breach(word " may be linked only in: " (link_places[i] == "" ? "nothing" : link_places[i]))
}

FNR == 1 { linking = 0 }

FILENAME ~ /rules\.txt$/ {
  if ($0 ~ /^#/ || NF == 0) next
  colon = match($0, /: |:$/)
  left = substr($0, 1, colon - 1)
  right = substr($0, colon + 2)
  # A place may itself hold a colon, and a pattern may: the list begins at the last ": ".
  while ((more = match(right, /: |:$/)) && left ~ /^(foreign|link) /) {
    left = left ": " substr(right, 1, more - 1)
    right = substr(right, more + 2)
  }
  if (sub(/^foreign /, "", left)) {
    foreign_pattern[++foreign_count] = left
    foreign_places[foreign_count] = right
  } else if (sub(/^link /, "", left)) {
    link_pattern[++link_count] = left
    link_places[link_count] = right
  } else {
    arrows[left] = right
  }
  next
}

FILENAME ~ /CMakeLists\.txt$/ {
  line = $0
  sub(/#.*/, "", line)
  if (line ~ /target_link_libraries\(/) {
    linking = 1
    sub(/.*target_link_libraries\([^ )]*/, "", line)
  }
  if (linking) {
    ended = sub(/\).*/, "", line)
    count = split(line, words, /[ \t]+/)
    for (w = 1; w <= count; w++) checkLink(words[w])
    if (ended) linking = 0
  }
  next
}

/^[ \t]*#[ \t]*include[ \t]*"/ {
  split($0, quoted, "\"")
  header = quoted[2]
  room = roomOf(FILENAME)
  if (header ~ /\.moc$/) next
  if (!(room in arrows)) breach("the room " room " is not in the rules")
  else if (header !~ /^(app|core|ui)\//) breach("\"" header "\" must be named from the root of the repository")
  else if (!maySee(room, header)) breach(room " may not include " header)
  else if (!maySeeInside(FILENAME, header)) breach(cornerOf(FILENAME) " may not include " header)
}

/^[ \t]*#[ \t]*include[ \t]*</ {
  header = $0
  sub(/^[^<]*</, "", header)
  sub(/>.*/, "", header)
  checkForeign(header)
}
