#!/usr/bin/env bash
# Is every C++ file and every kernel formatted as .clang-format says? Exit code 77: cannot tell here.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

# Versions differ in what they make of the same rules.
needed=14
format=$(command -v "clang-format-$needed" || command -v clang-format || true)
version=none
if [ -n "$format" ]; then
  version=$("$format" --version | sed -n 's/.*version \([0-9]*\)\..*/\1/p')
fi
if [ "$version" != "$needed" ]; then
  printf 'lint: the code is formatted by clang-format %s; here is %s\n' "$needed" "$version" >&2
  exit 77
fi
find bench fuzz host kernels tests -regex '.*\.\(cpp\|h\|cl\|clh\)' -print0 |
  xargs -0 -n 50 -P "$(nproc)" "$format" --dry-run -Werror --ferror-limit=1 || {
  printf 'lint: run clang-format -i over the files above\n' >&2
  exit 1
}
