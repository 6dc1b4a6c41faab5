# Minimal roots of a Debian release with this source in them. To be sourced; needs root and debootstrap. BDPT_MIRROR names
# another mirror. What is mounted goes when the script ends.
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mounts=()
unmount() {
  for point in "${mounts[@]}"; do umount "$point"; done
}
trap unmount EXIT

make_root() { # SUITE FOLDER: the work tree, but what git ignores, is in FOLDER/src/main
  local suite=$1 root=$2
  [ -x "$root/usr/bin/apt-get" ] ||
    debootstrap --variant=minbase "$suite" "$root" "${BDPT_MIRROR:-http://deb.debian.org/debian}" > /dev/null
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  for point in proc dev; do
    mount --bind "/$point" "$root/$point"
    mounts+=("$root/$point")
  done
  rm -rf "$root/src"
  mkdir -p "$root/src/main"
  (cd "$source" && git ls-files -z --cached --others --exclude-standard | tar -c --null --files-from=-) |
    tar -x -C "$root/src/main"
}

inside() { # FOLDER COMMAND...: runs it there, with nothing of this environment
  local root=$1
  shift
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"
}
