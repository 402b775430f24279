# The demo: bakes the courtyard and makes pictures of its lightmaps. Sourced by ./dev.

# NAME.exr -> pictures/NAME.{flat,rnm0,rnm1,rnm2}.png, exposed for the sunlit parts. A normal equal to a basis vector
# decodes to that vector's map.
pictures() {
  local folder=$1 file name map normals=(
    flat=0,0,1 rnm0=0.816497,0,0.577350 rnm1=-0.408248,0.707107,0.577350 rnm2=-0.408248,-0.707107,0.577350)
  mkdir -p "$folder/pictures"
  for file in "$folder"/*.exr; do
    name=$(basename "$file" .exr)
    for map in "${normals[@]}"; do
      build/release/rnmbake -q decode "$file" --exposure -1.5 --normal-vector "${map#*=}" \
        --variant "$([[ $map == flat=* ]] && echo single || echo squared)" \
        -o "$folder/pictures/$name.${map%%=*}.png"
    done
  done
}

demo() {
  build release --target rnmbake
  scenes panels
  build/release/rnmbake bake scenes/panels.toml -o out/demo
  pictures out/demo
  echo
  echo "Lightmaps ($(find out/demo -name '*.exr' | wc -l), layered EXR) and manifest.json: $PWD/out/demo"
  echo "Pictures of them:  $PWD/out/demo/pictures"
  echo "Try:  build/release/rnmbake inspect scenes/panels.toml"
}
