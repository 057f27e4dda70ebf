#!/usr/bin/env bash
# source_archive.sh SOURCE BUILD FOLDER   what `package_source` packs is all that a build needs, and knows
# its version, also inside of a repository that is not its own
set -euo pipefail
fail() { echo "source_archive.sh: $*" >&2; exit 1; }

source=$1 build=$2 folder=$3
name=glintmark-$(cat "$source/VERSION")
around=$folder/around
tree=$around/$name

# version TREE: what a program built from it says.
version() {
  cmake -D SOURCE="$1" -D OUTPUT="$folder/version.h" -P "$1/host/report/record/git_version.cmake"
  sed -n 's/.* "\(.*\)"$/\1/p' "$folder/version.h"
}
# pack BUILD FOLDER: prints what it has packed.
pack() {
  cpack --config "$1/CPackSourceConfig.cmake" -B "$2" >&2
  cmake -E tar tf "$2/$name.tar.gz" | LC_ALL=C sort
}

rm -rf "$folder"
mkdir -p "$around"
packed=$(pack "$build" "$folder")
if grep -E "^$name/(\.git|build|results/latest)/" <<<"$packed"; then fail "packs what is not source"; fi
cmake -E chdir "$around" cmake -E tar xf "$folder/$name.tar.gz"
[ -x "$tree/run" ] || fail "no run"
expected=$(version "$source")
if command -v git >/dev/null; then
  git init -q "$around"
  git -C "$around" -c user.name=another -c user.email=another@example.org \
    commit -q --allow-empty -m "another repository"
  # Those that are there: a checkout may have lost some.
  if [ -e "$source/.git" ]; then
    git -c safe.directory='*' -C "$source" ls-files -z |
      while IFS= read -r -d '' file; do
        if [ -e "$source/$file" ] && [ ! -e "$tree/$file" ]; then fail "no $file"; fi
      done
  fi
fi
[ "$(version "$tree")" = "$expected" ] || fail "version $(version "$tree") instead of $expected"

# It configures, and packs itself once more.
cmake --preset release -S "$tree" -B "$tree/build/release" -D GLINTMARK_TESTS=OFF \
  -D GLINTMARK_BENCHMARKS=OFF >/dev/null
[ "$(pack "$tree/build/release" "$folder/again")" = "$packed" ] || fail "packs something else"
