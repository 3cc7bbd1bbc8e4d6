# shellcheck shell=bash
# The Debian packages of packages.txt and other lists: which are missing, and their installation. Needs steps.sh.

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

# ensure_packages [LISTS]: leaves all packages of packages.txt and of the lists installed, or fails and says what to do.
ensure_packages() {
  local missing lists=(tools/setup/packages.txt "$@")
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system; the libraries of ${lists[*]} are taken to be there"
    return
  fi
  mapfile -t missing < <(missing_packages "${lists[@]}")
  if ((${#missing[@]} == 0)); then
    say "all packages are there"
  elif ((EUID == 0)); then
    install_packages "${missing[@]}"
  else
    fail "${#missing[@]} packages are missing; as root, or with sudo, install them and start again:
sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}"
  fi
}

install_packages() {
  # The lists of a fresh system are empty, those of an old one point to files that are gone.
  say "missing: $*"
  logged apt-update apt_get update
  logged apt-install apt_get install -y --no-install-recommends "$@"
}

apt_get() {
  local options=(-o DPkg::Lock::Timeout=300)
  # A machine that is thrown away needs no fsync after every file: half the time.
  if [[ -n ${CI:-} ]]; then options+=(-o DPkg::Options::=--force-unsafe-io); fi
  DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" "$@"
}
