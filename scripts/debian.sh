# What the other scripts install where it is missing, on Debian and its relatives. To be sourced.

# What a build needs, and what the tests need beyond that.
build_packages=(g++ cmake ninja-build pkg-config libembree-dev libtbb-dev libimath-dev libopenexr-dev libopencolorio-dev
  libpng-dev libjpeg-dev libcli11-dev libtinygltf-dev nlohmann-json3-dev libdraco-dev)
test_packages=(libgtest-dev libbenchmark-dev clang abigail-tools python3 cargo valgrind)

install_packages() {
  if ! command -v apt-get > /dev/null; then
    echo "no apt-get here: needs a C++20 compiler, cmake, ninja, Embree 3.13 or 4, oneTBB, Imath, OpenEXR," \
      "OpenColorIO, libpng, libjpeg, CLI11, tinygltf, nlohmann-json, GoogleTest and Google Benchmark; Draco for compressed glTF" >&2
    return
  fi
  local package status missing=() root=(env DEBIAN_FRONTEND=noninteractive)
  for package in "$@"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "installing ${missing[*]}"
  [ "$(id -u)" = 0 ] || root=(sudo "${root[@]}")
  # A source that has nothing to do with us may be down; what matters is whether the packages come.
  "${root[@]}" apt-get update -qq || true
  "${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
}
