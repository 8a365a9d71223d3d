# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# Shared by ./run and ./test: installs missing packages and builds. They source this file in the root folder, with
# `set -euo pipefail`. All messages go to standard error: standard output belongs to the started program.

# Nobody may be listening: that stops nothing.
say() { printf 'palpable: %s\n' "$*" >&2 || true; }

# If not empty, sudo is used without asking (./run -y, ./test -y); in continuous integration (CI is set) too.
assume_yes=

give_up() {
  say "$*"
  exit 1
}

# The packages of the given groups (packages/GROUP.txt). Debian's nodejs is omitted if a newer package replaces it, because
# both cannot be installed together.
packages_of() {
  local group names
  names=$(for group; do sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "packages/$group.txt"; done | sort -u)
  if node_is_enough; then names=$(grep -vxE 'nodejs|npm' <<<"$names"); fi
  printf '%s\n' "$names"
}

node_is_enough() {
  command -v node >/dev/null && command -v npm >/dev/null && [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ]
}

missing_of() {
  local name
  for name; do
    case $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null || true) in
      installed*) ;;
      *) printf '%s\n' "$name" ;;
    esac
  done
}

apt_install() {
  local apt=(apt-get -qq -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0) root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || give_up "these packages are missing, and there is no sudo to install them with: $*"
    root=(sudo -n)
    if [ -n "${CI-}" ] || [ -n "$assume_yes" ]; then
      sudo -n true 2>/dev/null || root=(sudo)
    elif [ -t 0 ] && [ -t 2 ]; then
      root=(sudo)
      local answer
      read -r -p "palpable: may sudo install these Debian packages? $* [Y/n] " answer >&2
      case $answer in [nN]*) give_up "nothing was installed, so nothing can be built" ;; esac
    elif ! sudo -n true 2>/dev/null; then
      give_up "sudo wants a password, and there is no terminal to ask for it. Install these first: sudo apt-get install $*"
    fi
  fi
  root+=(env DEBIAN_FRONTEND=noninteractive)
  say "installing with apt: $*"
  # The package lists are fetched only if they are missing or too old to find every file.
  if compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null &&
    "${root[@]}" "${apt[@]}" install -y --no-install-recommends "$@" >&2; then
    return
  fi
  say "refreshing apt's package lists"
  "${root[@]}" "${apt[@]}" update >&2 ||
    give_up "apt cannot refresh its package lists (see above); without a network install these packages first: $*"
  "${root[@]}" "${apt[@]}" install -y --no-install-recommends "$@" >&2 ||
    give_up "apt cannot install the packages (see above); without a network install these first: $*"
}

# install_packages GROUP…: installs the missing packages of the groups. A stamp of the lists and of dpkg's database makes
# later calls fast.
install_packages() {
  local stamp now missing
  command -v apt-get >/dev/null || give_up "this script installs with apt (Debian, Ubuntu); the packages are listed in packages/"
  stamp=build/.setup/packages-$(IFS=-; echo "$*")
  now=$(stat -c '%n %s %Y' packages/*.txt /var/lib/dpkg/status)
  if [ -f "$stamp" ] && [ "$(<"$stamp")" = "$now" ]; then return; fi
  mapfile -t missing < <(missing_of $(packages_of "$@"))
  if [ ${#missing[@]} -gt 0 ]; then apt_install "${missing[@]}"; fi
  stat -c '%n %s %Y' packages/*.txt /var/lib/dpkg/status >"$stamp"
}

# build PRESET [TARGET…]: configures if necessary, then builds the changed targets; prints nothing if nothing changed.
build() {
  local preset=$1 folder=build/$1
  shift
  if [ -d "$folder" ] && [ ! -w "$folder" ]; then
    give_up "$PWD/$folder was built by $(stat -c %U "$folder") and cannot be written by $(id -un): build a clone of your own, git clone '$PWD'"
  fi
  if [ ! -f "$folder/build.ninja" ]; then
    say "configuring ($preset)"
    cmake --preset "$preset" >&2 || give_up "cmake cannot configure the project (see above)"
    say "building; the first time takes some minutes"
  elif [ "$(ninja -C "$folder" -n "$@" | tail -n 1)" = 'ninja: no work to do.' ]; then
    return
  fi
  ninja -C "$folder" "$@" >&2 || give_up "the build failed (see above)"
}

# Only one script installs and builds at a time; another one waits.
take_turns() {
  if ! mkdir -p build/.setup 2>/dev/null || ! { : >>build/.setup/lock; } 2>/dev/null; then
    give_up "$PWD/build cannot be written by $(id -un) (the clone belongs to $(stat -c %U .)): build a clone of your own, git clone '$PWD'"
  fi
  exec {turn}>build/.setup/lock
  flock -n "$turn" || { say "waiting for another ./run or ./test to finish building"; flock "$turn"; }
}

end_turn() { exec {turn}>&-; }
