# pictures.sh - the pictures of README.md and docs/ssbump.md, which come from runs of the program. Sourced by ./dev.

views=out/pictures/views

# Views side by side, as shown on a screen. The arguments name them: upper left, upper right, lower left, lower right.
mosaic() {
  oiiotool --nosoftwareattrib "${@/#/$views/}" --eraseattrib "Software|Exif:.*" --mosaic:pad=4 2x2 --clamp:min=0:max=1 --colorconvert linear sRGB --ch R,G,B \
    -d uint8 --compression jpeg:92 -o docs/images/views.jpg
}

# docs/images/report.png, views.jpg and ssbump-*.png, and the figures that README.md quotes.
pictures() {
  require "${test_packages[@]}"
  build release --target rnmbake
  scenes panels
  local rnmbake=build/release/rnmbake
  "$rnmbake" validate scenes/panels.toml -o out/pictures/validate --resolution 32 --samples 64 --view 320
  python3 tools/dev/report_picture.py out/pictures/validate/report.html docs/images/report.png \
    --width 1200 --height 1240
  "$rnmbake" -q bake scenes/panels.toml -o out/pictures/lightmaps --materials lambert --normalize flat \
    --resolution 96 --samples 48
  "$rnmbake" -q render scenes/panels.toml --lightmaps out/pictures/lightmaps --compare --resolution 400x250 \
    --samples 64 -o "$views"
  python3 tools/dev/ssbump_picture.py "$rnmbake" out/pictures/ssbump docs/images
  mosaic cycles.exr truth.exr single-lightmap.exr rnm-squared.exr
  python3 tools/dev/readme_figures.py out/pictures/validate/report.json "$views/report.json"
}
