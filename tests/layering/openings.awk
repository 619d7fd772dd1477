# Prints files of more than 400 lines, without an SPDX line, or headers that do not say what they are for.
# SPDX-License-Identifier: GPL-3.0-or-later

function finish() {
  if (file == "") return
  if (lines > 400) printf "%s:400: the file has %d lines, more than 400\n", file, lines
  if (!licensed) printf "%s:1: no line \"// SPDX-License-Identifier: GPL-3.0-or-later\" at the top\n", file
}

FNR == 1 {
  finish()
  file = FILENAME
  licensed = 0
  in_opening = 1
  if (file ~ /\.h$/ && ($0 !~ /^\/\/ ./ || $0 ~ /SPDX/))
    printf "%s:1: the first line must say what the header is for\n", file
}
{ lines = FNR }
in_opening && /^\/\/ SPDX-License-Identifier: GPL-3\.0-or-later$/ { licensed = 1 }
!/^\/\// { in_opening = 0 }
END { finish() }
