#!/usr/bin/env bash
# run_without_tools.sh SOURCE FOLDER   ./run on systems that lack what it calls says so in one sentence
set -euo pipefail
fail() { echo "run_without_tools.sh: $*" >&2; exit 1; }

source=$1 folder=$2
bash=$(command -v bash)
rm -rf "$folder"
mkdir -p "$folder/bin"
for tool in dirname readlink id grep sed cksum cut mkdir; do ln -s "$(command -v $tool)" "$folder/bin/"; done

# fake NAME [TEXT]: a program of that name that prints TEXT.
fake() {
  printf '#!%s\nprintf "%%s\\n" "%s"\n' "$bash" "${2:-}" >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}

# says PARTS...: ./run ends with code 2 and sentences, in which PARTS stand.
says() {
  local code=0 text part
  text=$(PATH=$folder/bin CXX=${compiler:-} "$bash" "$source/run" info 2>&1 </dev/null) || code=$?
  [ "$code" -eq 2 ] || fail "exit code $code instead of 2: $text"
  for part in "$@"; do
    [[ $text == *"$part"* ]] || fail "no '$part' in: $text"
  done
  if grep -qv '^run: ' <<<"$text"; then fail "not all of it are sentences: $text"; fi
}

says "this system has no dpkg-query and apt-get: if packages are missing, CMake will name them" \
  "missing: cmake (3.25 or newer), ninja (Debian: ninja-build), a C++20 compiler (Debian: g++)"
fake dpkg-query
says "no dpkg-query and apt-get"
fake cmake "cmake version 3.22.1"
fake g++
says "missing: cmake (3.25 or newer, this is 3.22), ninja"
fake cmake "cmake version 4.0.2"
fake ninja-build
compiler='nowhere++ -O2' says "missing: the compiler 'nowhere++ -O2' that CXX names"
