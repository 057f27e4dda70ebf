#!/usr/bin/env bash
# installed.sh tree BUILD TREE           installs into TREE and looks for what should be there
# installed.sh program SOURCE TREE       the program works with what is in TREE, and with nothing else
# installed.sh sample SOURCE TREE HITS   a project of its own finds the kernels and shades HITS
set -euo pipefail
fail() { echo "installed.sh: $*" >&2; exit 1; }

what=$1 from=$2 tree=$3
program=$tree/bin/glintmark
case $what in
  tree)
    rm -rf "$tree"
    cmake --install "$from" --prefix "$tree" >/dev/null
    for file in bin/glintmark lib/glintmark/glintmark_codec.so share/glintmark/kernels/shade.cl \
      share/glintmark/kernels/glint/glint.clh share/glintmark/scenes/snow.toml \
      share/glintmark/data/ltc_ggx.table share/man/man1/glintmark.1.gz \
      share/bash-completion/completions/glintmark share/doc/glintmark/copyright; do
      [ -f "$tree/$file" ] || fail "no $file"
    done
    # The manual has every command, in roff.
    page=$(gzip -dc "$tree/share/man/man1/glintmark.1.gz")
    for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
      grep -qx "\.SS $command" <<<"$page" || fail "the manual has no $command"
    done
    grep -q 'Example' <<<"$page" || fail "the manual has no examples"
    ;;
  program)
    [ "$("$program" --version | cut -d ' ' -f 2)" = "$(cat "$from/VERSION")" ] || fail "another version"
    # A scene and a fault that only this tree has.
    cp "$tree/share/glintmark/scenes/"{screen_plane,only_here}.toml
    cd "$tree"
    "$program" --quiet render only_here --size 32x18 -o picture.png >/dev/null
    [ -s picture.png ] || fail "no picture"
    config=$tree/share/glintmark/kernels/config.clh
    cp "$config" config.kept
    echo '#error of the installed tree' >>"$config"
    # What a failed build leaves for its reader goes away with the tree.
    if message=$(TMPDIR=$tree "$program" --quiet render only_here --size 32x18 -o broken.png 2>&1); then
      message="it rendered"
    fi
    cp config.kept "$config"
    grep -q 'of the installed tree' <<<"$message" || fail "kernels come from elsewhere: $message"
    # Completion asks the program.
    PATH=$tree/bin:$PATH
    # shellcheck source=/dev/null
    source "$tree/share/bash-completion/completions/glintmark"
    COMP_WORDS=(glintmark rep) COMP_CWORD=1
    _glintmark
    [ "${COMPREPLY[*]}" = report ] || fail "completion of 'rep' gives '${COMPREPLY[*]}'"
    COMP_WORDS=(glintmark render only_h) COMP_CWORD=2
    _glintmark
    [ "${COMPREPLY[*]}" = only_here ] || fail "completion of a scene gives '${COMPREPLY[*]}'"
    COMP_WORDS=(glintmark diff --js) COMP_CWORD=2
    _glintmark
    [ "${COMPREPLY[*]}" = --json ] || fail "completion of an option gives '${COMPREPLY[*]}'"
    ;;
  sample)
    build=$tree/sample_build
    cmake -G Ninja -S "$from/tests/install/sample" -B "$build" -D CMAKE_PREFIX_PATH="$tree" \
      -D GLINTMARK_SOURCE="$from" >/dev/null
    cmake --build "$build" >/dev/null
    kernels=$(cat "$build/kernels.txt")
    [ "$(readlink -f "$kernels")" = "$(readlink -f "$tree/share/glintmark/kernels")" ] ||
      fail "the project found the kernels of $kernels"
    "$build/shade_hits" "$4" "$kernels" 8 zk16
    ;;
  *) fail "what is '$what'" ;;
esac
