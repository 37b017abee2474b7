#!/bin/sh
# Finds a Chromium for the page's tests or, as root on Debian and its kin, installs Debian's, and Firefox.
for name in chromium chromium-browser google-chrome; do
  command -v "$name" >/dev/null && exit 0
done
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
  echo "Installing Chromium for the page's tests"
  apt-get update -qq >/dev/null 2>&1
  DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
    chromium firefox-esr fonts-dejavu-core >/dev/null 2>&1 && exit 0
fi
echo "There is no Chromium here: the page's tests will be skipped (on Debian: apt install chromium)" >&2
