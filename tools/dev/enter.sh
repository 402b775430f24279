#!/bin/sh
# enter.sh ROOT COMMAND [ARGS...] - runs a command inside a Debian root, seeing this checkout, /tmp
# and, where it is there, ../shared (scenes by others that some tests use).
# The mounts live in a mount namespace that ends with the command, so nothing can stay mounted whatever
# is killed; every step is an exec, so a signal to this process reaches the command itself.
set -eu
checkout=$(cd "$(dirname "$0")/../.." && pwd)
exec unshare --mount --propagation private sh -eu -c '
  checkout=$1 root=$2
  shift 2
  for folder in "$checkout" "${checkout%/*}/shared" /tmp /proc /sys /dev; do
    [ -d "$folder" ] || continue
    mkdir -p "$root$folder"
    mount --rbind "$folder" "$root$folder"
  done
  folder=$PWD
  [ -d "$root$folder" ] || folder=/
  exec chroot "$root" env --chdir="$folder" "$@"
' sh "$checkout" "$@"
