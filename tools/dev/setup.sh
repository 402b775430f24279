# setup.sh - which Debian packages each command needs, and how the missing ones get installed.
# Sourced by ./dev.

build_packages=(
  g++ cmake ninja-build python3
  libopenexr-dev libopenimageio-dev openimageio-tools
  libspdlog-dev libfmt-dev libxxhash-dev libutf8proc-dev libstb-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libgtest-dev libepoxy-dev
  libeigen3-dev libembree-dev libtbb-dev libhwy-dev zlib1g-dev libzstd-dev
)
blender_packages=(blender python3-numpy)
style_packages=(clang-format pyflakes3)
slurm_packages=(slurmctld slurmd slurm-client munge) # for a cluster of the tests' own
test_packages=("${build_packages[@]}" "${blender_packages[@]}" "${slurm_packages[@]}" python3-jsonschema python3-venv nodejs chromium glslang-tools libegl1 libgl1-mesa-dri)

die() {
  echo "dev: $*" >&2
  exit 1
}

# The file that keeps what step NAME printed.
log() {
  mkdir -p build/log
  echo "build/log/$1.log"
}

installed() {
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

# Installs those of the named packages that are missing; needs no root where none is.
require() {
  if ! command -v dpkg-query >/dev/null; then
    echo "dev: this is no Debian, nothing is installed by itself; needed are: $*" >&2
    return
  fi
  local package missing=() sudo=()
  for package in "$@"; do
    installed "$package" || missing+=("$package")
  done
  if [[ ${#missing[@]} == 0 ]]; then return; fi

  if [[ $EUID != 0 ]]; then
    command -v sudo >/dev/null || die "please install as root: apt-get install ${missing[*]}"
    sudo=(sudo)
  fi
  echo "dev: installing ${missing[*]}" >&2
  {
    "${sudo[@]}" apt-get update &&
      "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --yes --no-install-recommends "${missing[@]}"
  } >"$(log apt)" 2>&1 || die "apt-get failed, see $(log apt): $(tail -n 3 "$(log apt)")"
}
