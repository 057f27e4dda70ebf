#!/usr/bin/env bash
# clang-tidy as .clang-tidy says, over the C++ files that changed since main, or over `all`.
# `./run lint` has configured build/lint.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

cpp_files() { find bench fuzz host tests -name '*.cpp'; }

# What differs from the last commit that is on main too, committed or not.
changed_files() {
  local main base
  for main in origin/main main; do
    if base=$(git merge-base HEAD "$main" 2>/dev/null); then break; fi
  done
  git diff --name-only --diff-filter=d "${base:-HEAD}"
  git ls-files --others --exclude-standard
}

# The changed sources, and those beside a changed header.
changed_cpp_files() {
  local file
  changed_files | while read -r file; do
    case "$file" in
      *.h) file=${file%.h}.cpp ;;
    esac
    if [[ $file == *.cpp && -f $file ]]; then printf '%s\n' "$file"; fi
  done | sort -u
}

if [ "${1-}" = all ] || ! git rev-parse --git-dir >/dev/null 2>&1; then
  mapfile -t files < <(cpp_files)
else
  mapfile -t files < <(changed_cpp_files)
fi
printf 'lint: clang-tidy over %d files\n' "${#files[@]}" >&2
if [ "${#files[@]}" -eq 0 ]; then exit 0; fi
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/lint --quiet --warnings-as-errors='*'
