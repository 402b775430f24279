// cli/about.h - what the help says of rnmbake and of each command, beside the flags.
#pragma once

namespace rnmbake {

inline constexpr const char* purpose =
    "rnmbake bakes the light of a Blender or glTF scene into directional lightmaps: for each\n"
    "object one EXR with the plain lightmap and the three maps of the Half-Life 2 basis (radiosity\n"
    "normal maps), from which an engine lights normal-mapped surfaces. Blender's Cycles does the\n"
    "tracing, headless; the encoding is exact, and every file says in its header what it holds.\n"
    "A path tracer of its own tells how exact.";

inline constexpr const char* examples =
    "Examples:\n"
    "  rnmbake doctor                                   is there a Blender that can bake?\n"
    "  rnmbake inspect hall.blend                       what would be baked, at which size\n"
    "  rnmbake bake hall.blend -o lightmaps             bake everything\n"
    "  rnmbake bake hall.toml --samples 64              a project file, with one setting changed\n"
    "  rnmbake validate hall.blend -o proof             how wrong is the bake, and why?\n"
    "  rnmbake reference hall.blend -o truth            what the lightmaps should hold, traced\n"
    "  rnmbake compare lightmaps truth -o report        how far apart are the two?\n"
    "  rnmbake render hall.blend --lightmaps lightmaps -o view.png\n"
    "  rnmbake decode lightmaps/floor.exr --normal n.png -o lit.exr\n"
    "  rnmbake ssbump bricks_height.png -o bricks_ssbump.png\n"
    "  rnmbake shaders --engine unity sh2 -o Assets     how a shader decodes it\n"
    "\n"
    "rnmbake COMMAND --help explains a command. Exit codes: 0 ok, 1 usage, 2 file, 3 scene content,\n"
    "4 no usable Blender, 5 unsupported, 6 some objects failed, 7 threshold exceeded, 8 locked.";

inline constexpr const char* about_bake =
    "\n\nFor every render-enabled object that has faces, Blender bakes the light that arrives along the\n"
    "plain normal and along each vector of the basis; the results are merged into one EXR for each\n"
    "object, beside a manifest.json that says what was baked, how and with what. The scene file itself\n"
    "is never changed. Settings that matter most: --objects, --resolution or --texels-per-unit,\n"
    "--samples, --output.";

inline constexpr const char* about_inspect =
    "\n\nSays what `rnmbake bake` with the same settings would bake and at which size, and what in the\n"
    "scene would get in its way; nothing is baked or written.";

inline constexpr const char* about_probes =
    "\n\nLight probes hold the light that reaches a point from all around: what characters and props are\n"
    "lit by, as lightmaps light what stands still. A box of them is filled around the scene, or where\n"
    "Blender's own light probe volumes stand; probes inside of geometry are moved out of it or filled\n"
    "from their neighbours. Writes probes.json and an EXR for each volume: irradiance at 14 normals with\n"
    "standard errors, ambient cube and harmonics of order 3.\n"
    "\n"
    "Examples:\n"
    "  rnmbake probes hall.blend -o volume --spacing 1              a box around the scene\n"
    "  rnmbake probes hall.blend -o volume --bounds 0,0,0,8,6,3     a box of this size\n"
    "  rnmbake probes hall.blend -o volume --dynamic 'Hero*,Door'   without what moves\n"
    "  rnmbake probes hall.blend -o volume --lights static          lamps stay the engine's own";

inline constexpr const char* about_export =
    "\n\nAlbedo and emission of every surface as Cycles shows them, lights, world, camera and the lightmap\n"
    "UVs, in one .rnmscene file; nothing of the scene is changed. What the reference cannot follow is "
    "listed\n"
    "object by object. --output names the file, or a folder for SCENE.rnmscene.";

inline constexpr const char* about_reference =
    "\n\nTraces the light itself, without Blender's Cycles: a diffuse path tracer that gives all directions\n"
    "in one pass, without bias and with the standard error of every texel. What it traces is the scene that\n"
    "`bake --materials lambert` bakes; files, names and layers are those of a bake, so every tool takes\n"
    "either. A .rnmscene made by `rnmbake export` needs no Blender.";

inline constexpr const char* about_validate =
    "\n\nBakes the scene with both recipes, twice each so that the noise is known, traces the truth, and\n"
    "traces the published recipe's faults one after the other. What comes out is one page, DIR/report.html,\n"
    "in which every part of the error has a name, a number and a confidence interval. --samples is the sum\n"
    "over the two halves of a bake.";

inline constexpr const char* about_compare =
    "\n\nA and B are folders that `rnmbake bake` or `rnmbake reference` wrote, or two lightmaps. Errors are "
    "A\n"
    "minus B, over the texels that both cover; known noise is taken out, and every mean has its 95 %\n"
    "confidence interval. Exit code 7 says that a limit of --fail-above was exceeded.";

inline constexpr const char* about_convert =
    "\n\nOne bake feeds every encoding: LIGHTMAPS is a folder that `rnmbake bake` wrote, or one lightmap, "
    "and -o "
    "gets\n"
    "the same light in the layers that another decoder expects. `rnmbake decode` and `rnmbake render` read "
    "them "
    "by\n"
    "their headers; docs/convert.md says which encoding loses what.";

inline constexpr const char* about_deliver =
    "\n\nOne command from a scene to an engine: what is not baked yet is baked, the maps of all objects are\n"
    "packed into a few pages, the scene becomes a .glb whose second UV set leads there, and lightmaps.json\n"
    "says which object lies where. SCENE may also be a folder that `rnmbake bake --save-scene always` wrote.";

inline constexpr const char* about_ssbump =
    "\n\nStores, for each texel of a height map, how much of the light along each of the three axes of the\n"
    "Half-Life 2 basis arrives past the heights around it. A shader then needs no normal map: light is the\n"
    "sum of channel times lightmap. Height, --wrap and --handed decide what comes out; --alpha up adds a\n"
    "fourth direction. A word in place of INPUT names a tool for maps that are already there.";

inline constexpr const char* about_nms =
    "\n\nBoris Vorontsov's method (2020): from each texel the normals are walked towards the light, and "
    "where "
    "they\n"
    "rise over its ray there is shadow. No height map is needed, but the normals have to be those of a "
    "surface:\n"
    "--check says how far they are from that.";

inline constexpr const char* about_shaders =
    "\n\nPrints GLSL or HLSL functions that decode what rnmbake writes: lightmaps in each encoding,\n"
    "self-shadowed bump maps, shadows out of normal maps. --engine says for whom: the language, the file's\n"
    "ending, and functions with the names that its materials have. --engine blender starts Blender and\n"
    "writes a .blend of groups of nodes, one for each encoding.";

inline constexpr const char* about_cache =
    "\n\nResults of earlier runs that later ones need not make again lie in one folder, under the hash of "
    "all\n"
    "that they were made from: they never grow stale, and deleting any of them costs time alone. --cache, "
    "the\n"
    "variable RNMBAKE_CACHE or `cache` in [run] of a project file name the folder, --cache-limit its size.";

inline constexpr const char* about_submit =
    "\n\nPlans what `rnmbake bake` with the same settings would bake, and writes it down as tasks that any\n"
    "machine may run which sees the plan, the cache and the scene under the same names. Their results meet "
    "in\n"
    "the cache; a last `rnmbake bake ... --merge PLAN` makes the lightmaps, the same to the last digit as\n"
    "those of one machine. docs/farm.md tells how, for any queue.";

inline constexpr const char* about_task =
    "\n\nBakes those passes of one task that the cache does not hold, and writes PLAN/tasks/N.json. It may "
    "be\n"
    "killed and run again, or run twice at once. Exit code 6 says that objects failed.";

inline constexpr const char* about_status =
    "\n\nCounts the files in PLAN/tasks, which are the truth whatever a queue remembers, and says what the\n"
    "queue knows.";

inline constexpr const char* about_render =
    "\n\nThe view of the scene's camera: albedo times the light that a shader reads from the lightmaps with "
    "the\n"
    "material's normal map, plus what glows, with the world behind. --decode truth traces that light at "
    "each\n"
    "pixel instead, --with cycles asks Blender, and --compare puts all of them side by side on one page.";

}  // namespace rnmbake
