# shellcheck shell=bash
# Finds and installs missing Debian packages of packages.txt and other lists. Needs steps.sh.

listed_packages() { awk '!/^#/ && NF {print $1}' "$@"; }

is_installed() {
  # One line for each architecture.
  # shellcheck disable=SC2016  # the braces are dpkg-query's
  grep -qx installed < <(dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null)
}

missing_packages() {
  local package
  for package in $(listed_packages "$@"); do
    if ! is_installed "$package"; then printf '%s\n' "$package"; fi
  done
}

# ensure_packages [LISTS]: installs missing packages of packages.txt and of the lists, or fails with the command to do so.
ensure_packages() {
  local missing lists=(tools/setup/packages.txt "$@")
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system; the libraries of ${lists[*]} are assumed to be installed"
    return
  fi
  mapfile -t missing < <(missing_packages "${lists[@]}")
  if ((${#missing[@]} == 0)); then
    say "all packages are installed"
  elif ((EUID == 0)); then
    install_packages "${missing[@]}"
  else
    fail "${#missing[@]} packages are missing; as root, or with sudo, install them and start again:
sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}"
  fi
}

install_packages() {
  # Package lists are empty on a new system and outdated on an old one.
  say "missing: $*"
  logged apt-update apt_get update
  logged apt-install apt_get install -y --no-install-recommends "$@"
}

apt_get() {
  local options=(-o DPkg::Lock::Timeout=300)
  # On a temporary machine, no fsync after every file: half the time.
  if [[ -n ${CI:-} ]]; then options+=(-o DPkg::Options::=--force-unsafe-io); fi
  DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" "$@"
}
