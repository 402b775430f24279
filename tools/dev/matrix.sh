# matrix.sh - the Blender tests on other Debian releases, each in a root of its own under .roots/, and on blender.org's
# Blenders as PyPI has them, each in a virtual environment there.
# Sourced by ./dev. What cannot be fetched is reported as SKIPPED with its reason, never as passed.

enter() {
  tools/dev/enter.sh "$PWD/.roots/$1" "${@:2}"
}

# Why no root can be made here; nothing where one can.
obstacle() {
  if [[ $EUID != 0 ]]; then
    echo "making and entering a root needs root: sudo ./dev matrix"
  elif ! unshare --mount true 2>/dev/null; then
    echo "this machine allows no mount namespaces"
  elif ! (require debootstrap) >&2; then
    echo "debootstrap is missing and could not be installed"
  fi
}

# The smallest Debian SUITE in the new folder ROOT.
bootstrap() {
  local suite=$1 root=$2
  mkdir -p "$root"
  unshare --mount --propagation private debootstrap --variant=minbase "$suite" "$PWD/$root" \
    "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" || return
  printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" # start no services
  chmod +x "$root/usr/sbin/policy-rc.d"
  ln -sf /proc/self/mounts "$root/etc/mtab" # Blender warns without it
}

# Makes .roots/SUITE once. It grows as SUITE.part, so that one which was interrupted is never taken for a
# whole one; what debootstrap had finished is kept.
make_root() {
  local suite=$1 root=.roots/$1 part=.roots/$1.part
  if [[ -e $root/.complete ]]; then return; fi
  echo "dev: making a Debian $suite in $root (once)" >&2
  if [[ ! -e $part/.base ]]; then
    rm -rf --one-file-system "$part"
    bootstrap "$suite" "$part" || return
    touch "$part/.base"
  fi
  install_in "$suite.part" blender python3-numpy python3-requests python3-cattr || return
  touch "$part/.complete"
  rm -rf --one-file-system "$root"
  mv "$part" "$root"
}

# Signatures are checked; a mirror that lags behind (its index then counts as expired) is good enough here.
install_in() {
  cp --remove-destination /etc/resolv.conf ".roots/$1/etc/resolv.conf"
  enter "$1" dpkg --configure -a &&
    enter "$1" apt-get -o Acquire::Check-Valid-Until=false update &&
    enter "$1" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${@:2}"
}

# A program that tests can start in place of `blender`.
make_wrapper() {
  local wrapper=.roots/bin/blender-$1
  mkdir -p .roots/bin
  printf '#!/bin/sh\nexec "%s" "%s" blender "$@"\n' "$PWD/tools/dev/enter.sh" "$PWD/.roots/$1" >"$wrapper.new"
  chmod +x "$wrapper.new"
  mv "$wrapper.new" "$wrapper"
}

# Compiles rnmbake with the compiler and libraries of SUITE and runs the tests that need no Blender.
# Warnings are no errors here: which ones there are differs from compiler to compiler, as style does from
# clang-format to clang-format.
build_in() {
  local suite=$1 folder=$PWD/.roots/build-$1
  if [[ ! -e .roots/$suite/.build-packages || tools/dev/setup.sh -nt .roots/$suite/.build-packages ]]; then
    install_in "$suite" "${test_packages[@]}" >"$(log "$suite-packages")" 2>&1 || return
    touch ".roots/$suite/.build-packages"
  fi
  enter "$suite" cmake -G Ninja -S "$PWD" -B "$folder" -DCMAKE_BUILD_TYPE=Release -DRNMBAKE_WERROR=OFF &&
    enter "$suite" cmake --build "$folder" --parallel "$(nproc)" &&
    enter "$suite" ctest --test-dir "$folder" -L unit -LE style --output-on-failure --no-tests=error --parallel "$(nproc)"
}

# One suite from nothing to its verdict; prints the summary line last.
try_suite() {
  local suite=$1 version reason
  reason=$(obstacle)
  if [[ -z $reason ]] && ! make_root "$suite" >"$(log "$suite-root")" 2>&1; then
    reason="the root could not be made, see $(log "$suite-root"): $(tail -n 1 "$(log "$suite-root")")"
  fi
  if [[ -n $reason ]]; then
    echo "SKIPPED $suite: $reason"
    return
  fi
  make_wrapper "$suite"
  if ! version=$(".roots/bin/blender-$suite" --version 2>&1); then
    echo "SKIPPED $suite: its Blender does not start: $(tail -n 1 <<<"$version")"
    return
  fi
  version=${version%%$'\n'*}

  if [[ $with_build == yes ]] && ! build_in "$suite" >&2; then
    echo "FAILED  $suite: rnmbake does not compile there or fails its tests"
    return 1
  fi
  if ! RNMBAKE_BLENDER=$PWD/.roots/bin/blender-$suite TMPDIR=/tmp \
    ctest --test-dir build/release -L blender --output-on-failure --no-tests=error >&2; then
    echo "FAILED  $suite: $version"
    return 1
  fi
  echo "PASSED  $suite: $version"
}

# "4.5 python3.11" for each series of the module bpy of which PyPI has a wheel for a Python of this machine.
bpy_series() {
  local python
  for python in python3.{11..16}; do
    "$python" --version >/dev/null 2>&1 || continue
    "$python" -m pip --version >/dev/null 2>&1 || continue
    "$python" -m pip index versions bpy 2>/dev/null | sed -n 's/^Available versions: //p' | tr -d ' ' | tr , '\n' |
      cut -d. -f1,2 | uniq | sed "s/$/ $python/"
  done
}

# Makes .roots/bpy-SERIES once, with the newest module of the series, and a program that tests can start in place of
# `blender`.
make_bpy() {
  local series=$1 python=$2 root=.roots/bpy-$1 wrapper=.roots/bin/blender-bpy-$1
  if [[ ! -e $root/.complete ]]; then
    rm -rf --one-file-system "$root"
    "$python" -m venv "$root" &&
      "$root/bin/python3" -m pip install --quiet --disable-pip-version-check --only-binary :all: "bpy==$series.*" || return
    touch "$root/.complete"
  fi
  mkdir -p .roots/bin
  printf '#!/bin/sh\nexec "%s" "%s" "$@"\n' "$PWD/$root/bin/python3" "$PWD/blender_scripts/bpy_runner.py" >"$wrapper"
  chmod +x "$wrapper"
}

# One series from nothing to its verdict; prints the summary line last. Launches as --blender PYTHON makes them, then
# all tests with a program in between that takes Blender's own command line.
try_bpy() {
  local series=$1 python reason='' version
  python=$(bpy_series | sed -n "s/^${series//./\\.} //p" | tail -n 1)
  if [[ -z $python ]]; then
    reason="PyPI has no wheel of bpy $series for a Python of this machine (with pip and venv)"
  elif ! make_bpy "$series" "$python" >"$(log "bpy-$series")" 2>&1; then
    reason="it could not be installed, see $(log "bpy-$series"): $(tail -n 1 "$(log "bpy-$series")")"
  elif ! version=$(.roots/bin/blender-bpy-"$series" --version 2>&1); then
    reason="it cannot be imported: $(tail -n 1 <<<"$version")"
  fi
  if [[ -n $reason ]]; then
    echo "SKIPPED bpy-$series: $reason"
    return
  fi
  version=${version%%$'\n'*}
  if ! RNMBAKE_BLENDER=$PWD/.roots/bpy-$series/bin/python3 \
    ctest --test-dir build/release -R '^blender\.' --output-on-failure --no-tests=error >&2 ||
    ! RNMBAKE_BLENDER=$PWD/.roots/bin/blender-bpy-$series \
      ctest --test-dir build/release -L blender --output-on-failure --no-tests=error >&2; then
    echo "FAILED  bpy-$series: $version, module of $python"
    return 1
  fi
  echo "PASSED  bpy-$series: $version, module of $python"
}

matrix() {
  local with_build=no suites=() summary=() status=0 suite argument
  for argument in "$@"; do
    case $argument in
      --build) with_build=yes ;;
      trixie | sid | bpy-[0-9].[0-9]*) suites+=("$argument") ;;
      bpy) mapfile -t -O "${#suites[@]}" suites < <(bpy_series | sed 's/^/bpy-/; s/ .*//' | sort -uV) ;;
      *) die "./dev matrix knows trixie, sid, bpy, bpy-4.5 and the like, and --build, not $argument" ;;
    esac
  done
  if [[ ${#suites[@]} == 0 ]]; then
    mapfile -t suites < <(printf '%s\n' trixie sid && bpy_series | sed 's/^/bpy-/; s/ .*//' | sort -uV)
  fi

  require "${test_packages[@]}"
  build release
  scenes
  for suite in "${suites[@]}"; do
    case $suite in
      bpy-*) summary+=("$(try_bpy "${suite#bpy-}")") || status=1 ;;
      *) summary+=("$(try_suite "$suite")") || status=1 ;;
    esac
  done
  printf '%s\n' "" "${summary[@]}"
  return $status
}
