#!/bin/sh
# Installs the packages of a list that are missing: install_packages.sh [LIST], by default tools/packages.txt. Where that is
# not possible it says what to install.
set -eu
list=${1:-$(dirname "$0")/packages.txt}
packages=$(grep -v '^#' "$list")

if ! command -v dpkg-query >/dev/null 2>&1; then
  # Not Debian: the build itself says what it does not find.
  if [ ! -e build/.packages-hint ]; then
    echo "halfspace: this is not a Debian system. Install what these Debian 12 packages hold:" $packages >&2
    mkdir -p build && touch build/.packages-hint
  fi
  exit 0
fi

missing=
for package in $packages; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "halfspace: run as root, or install first: apt-get install --no-install-recommends$missing" >&2
  exit 1
fi
echo "halfspace: installing$missing"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends $missing >/dev/null
