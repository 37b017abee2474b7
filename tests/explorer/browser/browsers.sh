#!/bin/sh
# Finds Chromium and Firefox for the page's tests or, as root on Debian and its kin, installs Debian's.
found() {
  for name in "$@"; do
    command -v "$name" >/dev/null && return 0
  done
  return 1
}

missing=
found chromium chromium-browser google-chrome || missing="chromium fonts-dejavu-core"
found firefox-esr firefox || missing="$missing firefox-esr"
[ "$missing" ] || exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
  echo "Installing for the page's tests: $missing"
  apt-get update -qq >/dev/null 2>&1
  # shellcheck disable=SC2086 # several packages
  DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends $missing >/dev/null 2>&1 && exit 0
fi
echo "The page's tests are skipped in browsers that are not here (on Debian: apt install $missing)" >&2
