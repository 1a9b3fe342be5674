#!/usr/bin/env bash
# Makes the Debian package, installs it on a clean Debian root, tracks the installed demo there as a
# user would, and removes it without a trace. Exit code 77, skipped, without root or debootstrap.
#   deb_test.sh BUILD_FOLDER
# DEB_TEST_ROOT=/a/root is taken for the clean one, and kept; else one is made and removed.
set -euo pipefail
build=$1
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap dpkg-shlibdeps >/dev/null; then
  echo "deb_test: SKIPPED, it needs root, debootstrap and dpkg-dev"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.log" || { cat "$work/cpack.log"; exit 1; }
deb=$(echo "$work"/walktrack_*.deb)
dpkg-deb --info "$deb" | sed -n 's/^ \(Package\|Version\|Depends\|Installed-Size\)/\1/p'

root=${DEB_TEST_ROOT:-$work/root}
# The mirror of this machine, and what apt has to know to reach it.
mirror=$({ grep -rhoE '^(URIs:|deb) +[^ ]+debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null || true; } | awk 'NR == 1 {print $2}')
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
if [ ! -x "$root/usr/bin/apt-get" ]; then
  debootstrap --variant=minbase "$release" "$root" "${mirror:-http://deb.debian.org/debian}" >"$work/debootstrap.log" ||
    { tail -5 "$work/debootstrap.log"; exit 1; }
fi
for file in apt.conf apt.conf.d auth.conf auth.conf.d; do
  [ -e "/etc/apt/$file" ] && cp -r "/etc/apt/$file" "$root/etc/apt/"
done
cp "$deb" "$root/tmp/walktrack.deb"

in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
in_root apt-get update -qq
in_root dpkg-query -W -f '${Package}\n' | sort >"$work/packages_before"
in_root apt-get install -y -qq --no-install-recommends /tmp/walktrack.deb >"$work/install.log" 2>&1 || { tail -20 "$work/install.log"; exit 1; }

in_root walktrack --version
in_root walktrack check /usr/share/walktrack/demo/scene.yaml
in_root walktrack track /usr/share/walktrack/demo/scene.yaml -o /tmp/demo -y
in_root walktrack evaluate /usr/share/walktrack/demo/truth.csv /tmp/demo
for file in tmp/demo/report.html tmp/demo/run.json tmp/demo/overlay_side.mp4 usr/share/doc/walktrack/copyright \
  usr/share/doc/walktrack/guide/README.md usr/share/man/man1/walktrack.1.gz \
  usr/share/bash-completion/completions/walktrack usr/share/walktrack/configs/models/kneed_1.2.yaml \
  usr/share/walktrack/opensim/ik_setup.xml usr/lib/python3/dist-packages/walktrack.py tmp/demo/figure.glb; do
  # minbase leaves out manuals and documents; the package's own list does not.
  [ -e "$root/$file" ] || dpkg-deb --contents "$deb" | grep -q " ./$file\$" || { echo "deb_test: $file is missing"; exit 1; }
done

in_root apt-get purge -y -qq walktrack >/dev/null
in_root apt-get autoremove -y -qq --purge >/dev/null
left=$(find "$root" -xdev -ipath '*walktrack*' -not -path "$root/tmp/*" -not -path "$root/var/*" -not -path "$root/proc/*" -print)
[ -z "$left" ] || { echo "deb_test: left behind: $left"; exit 1; }
in_root dpkg-query -W -f '${Package}\n' | sort | diff "$work/packages_before" - || { echo "deb_test: packages left behind"; exit 1; }
rm -rf "$root/tmp/demo"
echo "installed, tracked the demo and removed on a clean Debian $release"
