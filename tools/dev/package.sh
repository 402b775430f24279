# package.sh - the Debian package: made, looked at by lintian, installed into a fresh root. Sourced by ./dev.
source tools/dev/matrix.sh

# A Debian of this machine's release in .roots/package, with nothing in it; copied from a base that is made once.
fresh_root() {
  local suite=$1 base=.roots/$1-base root=.roots/package
  if [[ ! -e $base/.complete ]]; then
    rm -rf --one-file-system "$base"
    bootstrap "$suite" "$base" || return
    touch "$base/.complete"
  fi
  rm -rf --one-file-system "$root"
  cp -a "$base" "$root"
}

# Installs FILE with what it depends on and recommends, and asks the program whether it can bake.
try_package() {
  local file=$1
  fresh_root "$2" || return
  cp --remove-destination /etc/resolv.conf .roots/package/etc/resolv.conf
  enter package apt-get -o Acquire::Check-Valid-Until=false update &&
    enter package env DEBIAN_FRONTEND=noninteractive apt-get install --yes "$file" || return
  enter package rnmbake --version && enter package rnmbake doctor
}

package() {
  local folder=$PWD/build/release/package file reason suite
  # shellcheck disable=SC1091
  suite=$(source /etc/os-release && echo "${VERSION_CODENAME:-}")
  require "${build_packages[@]}" dpkg-dev lintian
  build release --target rnmbake shell_files
  rm -rf "$folder"
  (cd build/release && cpack -G DEB -B "$folder") >"$(log cpack)" 2>&1 || die "no package, see $(log cpack)"
  file=$(echo "$folder"/*.deb)
  dpkg-deb --info "$file"
  lintian --fail-on error "$file" || die "lintian found errors"
  reason=$(obstacle)
  if [[ -n $reason ]]; then
    echo "SKIPPED installing it into a fresh Debian: $reason"
    return
  fi
  try_package "$file" "$suite" >"$(log package)" 2>&1 || die "it does not install or bake, see $(log package)"
  tail -n 16 "$(log package)"
  echo "PASSED  $file: installs into a fresh Debian $suite and finds its Blender"
}
