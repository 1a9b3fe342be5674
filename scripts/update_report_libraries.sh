#!/usr/bin/env bash
# Fetches the libraries of the report's page anew, in the versions named here, and writes them to
# data/report/libraries. Needs npm; building does not. Without changed versions nothing changes.
#   scripts/update_report_libraries.sh
set -euo pipefail
cd "$(dirname "$0")/.."
uplot=1.6.32
ogl=1.0.11
esbuild=0.28.2

work=build/report_libraries
into=data/report/libraries
mkdir -p "$work" "$into"
npm install --prefix "$work" --no-save --no-audit --no-fund --silent "uplot@$uplot" "ogl@$ogl" "esbuild@$esbuild"

modules=$work/node_modules
cp "$modules/uplot/dist/uPlot.iife.min.js" "$into/uplot.min.js"
cp "$modules/uplot/dist/uPlot.min.css" "$into/uplot.min.css"
cp "$modules/uplot/LICENSE" "$into/uplot.LICENSE"
# The classes that the page uses, as one global.
echo "export { Renderer, Camera, Transform, Program, Mesh, Cylinder, Sphere, Geometry, Orbit, Vec3 } from 'ogl';" >"$work/ogl.js"
"$modules/.bin/esbuild" "$work/ogl.js" --bundle --minify --format=iife --global-name=OGL --log-level=warning \
  --banner:js="/*! OGL $ogl, https://github.com/oframe/ogl, public domain (The Unlicense) */" --outfile="$into/ogl.min.js"

{
  echo "Libraries inside report.html, as published on npm; scripts/update_report_libraries.sh wrote them."
  echo
  echo "| library | version | licence | files |"
  echo "|---|---|---|---|"
  echo "| uPlot | $uplot | MIT (uplot.LICENSE) | uplot.min.js, uplot.min.css: as published |"
  echo "| OGL | $ogl | Unlicense (public domain) | ogl.min.js: bundled by esbuild $esbuild |"
  echo
  echo "Their checksums are in SHA256SUMS; a test compares them."
} >"$into/README.md"
(cd "$into" && sha256sum ogl.min.js uplot.min.css uplot.min.js >SHA256SUMS)
