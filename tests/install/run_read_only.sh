#!/usr/bin/env bash
# run_read_only.sh SOURCE   where ./run builds a checkout that cannot be written; as root, for another user
set -euo pipefail
fail() { echo "run_read_only.sh: $*" >&2; exit 1; }

# Not below the build folder, which others may not be able to enter.
folder=$(mktemp -d)
trap 'chmod -R u+w "$folder" && rm -rf "$folder"' EXIT
checkout=$folder/checkout
mkdir "$checkout" "$folder/home" "$folder/tmp" "$folder/bin"
cp "$1/run" "$checkout/"
for tool in bash dirname readlink id grep sed cksum cut mkdir; do ln -s "$(command -v $tool)" "$folder/bin/"; done
chmod 755 "$folder"
chmod 777 "$folder/home" "$folder/tmp"
chmod a-w "$checkout"
user=$(id -u)
as_user=()
if [ "$user" = 0 ]; then
  user=12345
  as_user=(setpriv --reuid $user --regid $user --clear-groups)
fi

# says PART VARIABLES...: with those variables ./run ${words[@]} says PART and ends with code 2, for this
# PATH has no compiler.
words=(info)
says() {
  local part=$1 code=0 text
  text=$("${as_user[@]}" env -i PATH="$folder/bin" TMPDIR="$folder/tmp" "${@:2}" \
    "$checkout/run" "${words[@]}" 2>&1 </dev/null) || code=$?
  [ "$code" -eq 2 ] || fail "exit code $code instead of 2: $text"
  [[ $text == *"$part"* ]] || fail "no '$part' in: $text"
  if grep -qv '^run: ' <<<"$text"; then fail "not all of it are sentences: $text"; fi
}

here="run: $checkout cannot be written: building in"
says "$here $folder/home/.cache/glintmark/build-" HOME="$folder/home"
says "is missing: cmake" HOME="$folder/home"
cd "$checkout"
words=()
says "run: $checkout cannot be written: results go to $folder/home/.cache/glintmark/build-" HOME="$folder/home"
words=(info)
cd /
says "$here $folder/home/caches/glintmark/build-" HOME=/nonexistent XDG_CACHE_HOME="$folder/home/caches"
says "cannot be written either; set XDG_CACHE_HOME to a folder of your own" HOME=/proc/nowhere
says "$here $folder/tmp/glintmark-$user/.cache/glintmark/build-"
says "is missing: cmake"
[ "$(stat -c %a "$folder/tmp/glintmark-$user")" = 700 ] || fail "others may enter the build of one without a home"
if [ "$(id -u)" = 0 ]; then
  chmod 777 "$folder/tmp/glintmark-$user"
  chown 54321 "$folder/tmp/glintmark-$user"
  says "belongs to another user; set XDG_CACHE_HOME to a folder of your own"
fi
