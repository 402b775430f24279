# The demo: bakes the courtyard, makes pictures of its lightmaps, and proves two scenes. Sourced by ./dev.

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

# How wrong is the bake of a scene? Small maps, so that it takes a minute or two; prints the finding.
prove() {
  build/release/rnmbake validate "scenes/$1.toml" -o "out/demo/validate-$1" --resolution 32 --samples 64 --view 320
}

demo() {
  build release --target rnmbake
  scenes panels cave
  build/release/rnmbake bake scenes/panels.toml -o out/demo
  pictures out/demo
  local scene findings=()
  for scene in panels cave; do
    findings+=("$scene: $(prove "$scene")") || die "the validation of $scene failed"
  done
  echo
  echo "Lightmaps ($(find out/demo -maxdepth 1 -name '*.exr' | wc -l), layered EXR) and manifest.json: $PWD/out/demo"
  echo "Pictures of them:  $PWD/out/demo/pictures"
  echo "How exact they are, as pages for a browser:"
  printf '  %s\n' "$PWD"/out/demo/validate-{panels,cave}/report.html
  printf '%s\n' "${findings[@]}"
  echo "Try:  build/release/rnmbake inspect scenes/panels.toml"
}
