// How a launch can end: with the installed Blender where it can be asked to, else with a shell script.
#include "blender/fixture.h"
#include "blender/private_environment.h"
#include "blender/progress_tail.h"
#include "process/stop.h"

#include <algorithm>
#include <fstream>
#include <thread>

#include <signal.h>  // NOLINT(modernize-deprecated-headers): SIGSEGV

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Kind = LaunchFailure::Kind;

/// A scripts folder with core/task.py and one entry, and a launch of that entry.
struct Bench {
  TempFolder folder;
  Launch launch;

  explicit Bench(const std::string& main_body) {
    const fs::path scripts = folder.path() / "scripts";
    fs::copy(fs::path(RNMBAKE_SOURCE_DIR) / "blender_scripts", scripts, fs::copy_options::recursive);
    write_atomically(scripts / "try_entry.py",
                     "import os, sys, time\n"
                     "sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))\n"
                     "import bpy\n"
                     "from core.task import Refusal, run\n"
                     "def main(task):\n" +
                         main_body + "\nrun(main)\n");
    launch.entry = "try_entry.py";
    launch.folder = folder.path() / "launch";
    launch.request = {{"number", 42}};
    make_folders(launch.folder);
  }

  LaunchOutcome with(const BlenderInfo& info, const LaunchLimits& limits = {},
                     const std::function<void(const ProgressEvent&)>& on_progress = {},
                     bool allow_scripts = false) {
    RealBlender blender(info, {{allow_scripts}, folder.path() / "scripts"});
    return blender.run(launch, limits, on_progress);
  }

  /// A shell script in Blender's place; $REQUEST is the request file.
  LaunchOutcome with_fake(const std::string& body, const LaunchLimits& limits = {}) {
    BlenderInfo info;
    info.executable =
        shell_script(folder.path() / "blender",
                     "for REQUEST in \"$@\"; do :; done\ncd \"$(dirname \"$REQUEST\")\"\n" + body);
    info.version = {4, 0, 0};
    return with(info, limits);
  }
};

LaunchFailure failure_of(const LaunchOutcome& outcome) {
  const auto* failure = std::get_if<LaunchFailure>(&outcome);
  if (failure != nullptr) return *failure;
  ADD_FAILURE() << "it finished";
  return {};
}

Finished finished(const LaunchOutcome& outcome) {
  if (const auto* result = std::get_if<Finished>(&outcome)) return *result;
  ADD_FAILURE() << std::get<LaunchFailure>(outcome).message << "\n"
                << std::get<LaunchFailure>(outcome).details;
  return {};
}

TEST(Launch, GivesTheResultAndTheProgress) {
  REQUIRE_BLENDER(blender);
  Bench bench(
      "    task.progress('bake', 'Cube', 1, 2)\n"
      "    return {'twice': 2 * task.request['number'], 'home': os.environ['HOME'],"
      " 'tmp': bpy.app.tempdir, 'threads': bpy.context.scene.render.threads}");
  bench.launch.threads = 1;
  std::vector<ProgressEvent> events;
  const Finished result =
      finished(bench.with(*blender, {}, [&](const ProgressEvent& e) { events.push_back(e); }));
  EXPECT_EQ(result.result.at("twice"), 84);
  EXPECT_EQ(result.result.at("home"), (bench.launch.folder / "home").string());
  EXPECT_TRUE(holds(result.result.at("tmp"), (bench.launch.folder / "tmp").string()));
  EXPECT_EQ(result.result.at("threads"), 1);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().what, "Cube");
  EXPECT_EQ(events.back().total, 2);
  EXPECT_GT(result.cpu_seconds, 0.05);
  EXPECT_GT(result.wall_seconds, 0.05);
  EXPECT_GT(result.peak_bytes, std::size_t{20} << 20);
}

TEST(Launch, ARefusalIsNotASuccess) {
  REQUIRE_BLENDER(blender);
  Bench bench("    raise Refusal('Cube: no faces; delete it', code=3, object_name='Cube')");
  const LaunchFailure failure = failure_of(bench.with(*blender));
  EXPECT_EQ(failure.kind, Kind::refused);
  EXPECT_EQ(failure.code, 3);
  EXPECT_EQ(failure.message, "Cube: no faces; delete it");
  EXPECT_EQ(failure.object, "Cube");
}

TEST(Launch, AnExceptionComesWithItsTraceback) {
  REQUIRE_BLENDER(blender);
  Bench bench("    return 1 / 0");
  const LaunchFailure failure = failure_of(bench.with(*blender));
  EXPECT_EQ(failure.kind, Kind::script);
  EXPECT_TRUE(holds(failure.message, "ZeroDivisionError")) << failure.message;
  EXPECT_TRUE(holds(failure.details, "line 6, in main")) << failure.details;
}

TEST(Launch, ASyntaxErrorIsAScriptFailureToo) {
  REQUIRE_BLENDER(blender);
  Bench bench("    return (");
  const LaunchFailure failure = failure_of(bench.with(*blender));
  EXPECT_EQ(failure.kind, Kind::script);
  EXPECT_TRUE(holds(failure.details, "SyntaxError")) << failure.details;
}

TEST(Launch, ACrashIsNamedByItsSignal) {
  REQUIRE_BLENDER(blender);
  Bench abort("    os.abort()");
  const LaunchFailure aborted = failure_of(abort.with(*blender));
  EXPECT_EQ(aborted.kind, Kind::crashed);
  EXPECT_TRUE(holds(aborted.message, "SIGABRT")) << aborted.message;
  Bench segv("    os.kill(os.getpid(), 11)\n    time.sleep(5)");
  const LaunchFailure crashed = failure_of(segv.with(*blender));
  EXPECT_EQ(crashed.kind, Kind::crashed);
  EXPECT_EQ(crashed.code, SIGSEGV);
}

TEST(Launch, QuittingEarlyIsNoResult) {
  REQUIRE_BLENDER(blender);
  Bench bench("    os._exit(0)");
  EXPECT_EQ(failure_of(bench.with(*blender)).kind, Kind::no_result);
}

TEST(Launch, IsEndedWhereItGetsNowhereOrTakesTooLong) {
  REQUIRE_BLENDER(blender);
  Bench bench("    task.progress('evaluate', 'Cube')\n    while True: print('busy', time.time())");
  const LaunchFailure hung = failure_of(bench.with(*blender, {4, 0}));
  EXPECT_EQ(hung.kind, Kind::hung) << hung.message;
  EXPECT_EQ(hung.message, "Blender made no progress for 4 s and was ended, at evaluate Cube");
  EXPECT_EQ(hung.phase, "evaluate");
  Bench endless(
      "    for n in range(10000):\n        task.progress('evaluate', str(n))\n        time.sleep(0.1)");
  const LaunchFailure outlasted = failure_of(endless.with(*blender, {600, 4}));
  EXPECT_EQ(outlasted.kind, Kind::outlasted) << outlasted.message;
  EXPECT_TRUE(holds(outlasted.message, "longer than the limit of 4 s")) << outlasted.message;
}

// A loop of Blender's own, within which no script says anything: the samples of one bake call are progress.
TEST(Launch, KnowsHowFarABakeCallIs) {
  REQUIRE_BLENDER(blender);
  if (blender->is_module && blender->version >= BlenderVersion{5, 0, 0})
    GTEST_SKIP() << "SKIPPED: from 5.0 on the module bpy cannot be asked to say it (docs/doctor.md)";
  Bench bench(R"(
    scene, ob = bpy.context.scene, bpy.context.object
    scene.render.engine = 'CYCLES'
    scene.cycles.samples, scene.cycles.use_adaptive_sampling, scene.cycles.use_denoising = 48, False, False
    image = bpy.data.images.new('x', 64, 64)
    material = bpy.data.materials.new('m')
    material.use_nodes = True
    ob.data.materials.clear()
    ob.data.materials.append(material)
    nodes = material.node_tree.nodes
    nodes.active = nodes.new('ShaderNodeTexImage')
    nodes.active.image = image
    task.progress('bake', 'atlas 1 of 1', 0, 100, 100, 48)
    bpy.ops.object.bake(type='DIFFUSE', margin=0)
    time.sleep(0.6)
    return {})");
  std::vector<ProgressEvent> events;
  finished(bench.with(*blender, {}, [&](const ProgressEvent& e) { events.push_back(e); }));
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().done, 100);
  EXPECT_EQ(events.back().detail, "48 of 48 samples");
}

// Python's own writing, a progress file without end, and pictures of Blender's, which says that it has
// finished.
TEST(Launch, AFullDiskIsNamed) {
  REQUIRE_BLENDER(blender);
  for (const char* body :
       {"    open(task.path('a'), 'wb').write(bytes(1 << 24))\n    return {}",
        "    while True: task.progress('evaluate', 'x' * 1000)",
        "    bpy.context.scene.render.engine = 'CYCLES'\n    bpy.context.scene.cycles.samples = 1\n"
        "    bpy.context.scene.cycles.use_denoising = False\n"
        "    bpy.context.scene.render.image_settings.file_format = 'OPEN_EXR'\n"
        "    bpy.context.scene.render.image_settings.color_depth = '32'\n"
        "    bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 1024\n"
        "    bpy.context.scene.render.filepath = task.path('a.exr')\n"
        "    bpy.ops.render.render(write_still=True)\n    return {}"}) {
    Bench bench(body);
    const std::string folder = bench.launch.folder.string();
    if (std::system(("mount -t tmpfs -o size=256k none " + folder + " 2>/dev/null").c_str()) != 0)
      GTEST_SKIP() << "SKIPPED: a small tmpfs needs root";
    const LaunchFailure failure = failure_of(bench.with(*blender));
    EXPECT_EQ(std::system(("umount " + folder).c_str()), 0);
    EXPECT_EQ(failure.kind, Kind::refused) << failure.message << failure.details;
    EXPECT_EQ(failure.code, static_cast<int>(ExitCode::io));
    EXPECT_TRUE(holds(failure.message, "the disk of " + folder + " is full")) << failure.message;
    EXPECT_TRUE(holds(failure.message, "TMPDIR")) << failure.message;
  }
}

TEST(Launch, ASceneThatCannotBeOpenedIsRefused) {
  REQUIRE_BLENDER(blender);
  Bench bench("    return {}");
  bench.launch.scene = BlendPath(bench.folder.path() / "no.blend");
  LaunchFailure failure = failure_of(bench.with(*blender));
  EXPECT_EQ(failure.kind, Kind::refused);
  EXPECT_EQ(failure.code, static_cast<int>(ExitCode::io));
  EXPECT_TRUE(holds(failure.message, "no.blend")) << failure.message;
  write_atomically(bench.launch.scene->path(), "this is no .blend at all");
  failure = failure_of(bench.with(*blender));
  EXPECT_EQ(failure.kind, Kind::refused);
  EXPECT_EQ(failure.code, static_cast<int>(ExitCode::invalid_input));
  EXPECT_TRUE(holds(failure.message, "is no .blend file")) << failure.message;
}

TEST(Launch, ScriptsInsideTheSceneRunOnlyIfAllowed) {
  REQUIRE_BLENDER(blender);
  Bench maker(
      "    text = bpy.data.texts.new('auto.py'); text.write('import bpy; bpy.context.scene[\"ran\"] = 1')\n"
      "    text.use_module = True\n"
      "    bpy.ops.wm.save_as_mainfile(filepath=task.path('auto.blend'))\n"
      "    return {}");
  finished(maker.with(*blender));
  Bench bench("    return {'ran': 'ran' in bpy.context.scene, 'blocked': bpy.app.autoexec_fail}");
  bench.launch.scene = BlendPath(maker.launch.folder / "auto.blend");
  const auto untrusted = finished(bench.with(*blender)).result;
  EXPECT_FALSE(untrusted.at("ran"));
  EXPECT_TRUE(untrusted.at("blocked"));
  EXPECT_TRUE(finished(bench.with(*blender, {}, {}, true)).result.at("ran"));
}

TEST(Launch, StopsWhenTheUserWantsTo) {
  Bench bench("");
  std::thread user([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    StopRequest::request(SIGINT);
  });
  EXPECT_EQ(failure_of(bench.with_fake("sleep 60")).kind, Kind::stopped);
  user.join();
  StopRequest::reset();
}

TEST(FakeLaunch, FaultsAreToldApart) {
  Bench bench("");
  EXPECT_EQ(failure_of(bench.with_fake("exit 0")).kind, Kind::no_result);
  EXPECT_EQ(failure_of(bench.with_fake("kill -SEGV $$")).kind, Kind::crashed);
  EXPECT_EQ(failure_of(bench.with_fake("exit 139")).kind, Kind::crashed) << "a wrapper's word for SIGSEGV";
  const LaunchFailure killed = failure_of(bench.with_fake("echo last words; kill -9 $$"));
  EXPECT_EQ(killed.kind, Kind::killed);
  EXPECT_TRUE(holds(killed.message, "memory")) << killed.message;
  EXPECT_EQ(killed.details, "last words\n");
  EXPECT_EQ(failure_of(bench.with_fake("sleep 60", {600, 0.5})).kind, Kind::outlasted);
  const LaunchFailure quiet = failure_of(bench.with_fake("sleep 60", {0.5, 0}));
  EXPECT_EQ(quiet.kind, Kind::hung);
  EXPECT_TRUE(holds(quiet.message, "at start-up")) << quiet.message;
  EXPECT_TRUE(quiet.phase.empty());
}

TEST(FakeLaunch, OnlyTheRightNonceAndExitZeroCount) {
  Bench bench("");
  const std::string right = R"x(nonce=$(sed 's/.*"nonce":"\([0-9a-f]*\)".*/\1/' "$REQUEST"))x";
  const std::string answer = R"x(; echo "{\"ok\":{\"n\":1},\"nonce\":\"$nonce\"}" > result.json; )x";
  EXPECT_EQ(finished(bench.with_fake(right + answer)).result.at("n"), 1);
  EXPECT_EQ(failure_of(bench.with_fake("exit 0")).kind, Kind::no_result) << "yesterday's result file";
  EXPECT_EQ(failure_of(bench.with_fake("nonce=123" + answer)).kind, Kind::no_result);
  EXPECT_EQ(failure_of(bench.with_fake(right + answer + "exit 1")).kind, Kind::no_result);
  EXPECT_EQ(failure_of(bench.with_fake(right + answer + "kill -SEGV $$")).kind, Kind::crashed);
  EXPECT_EQ(failure_of(bench.with_fake("echo '{\"ok\"' > result.json")).kind, Kind::no_result);
  EXPECT_EQ(failure_of(bench.with_fake("echo '[1]' > result.json")).kind, Kind::no_result);
}

TEST(LaunchArgv, GatesWhatOldBlendersDoNotKnow) {
  const ScriptFolder scripts;
  BlenderInfo info;
  info.executable = "/b";
  Launch launch;
  launch.entry = "probe_entry.py";
  launch.folder = "/f";
  launch.scene = BlendPath("/s.blend");
  launch.threads = 3;
  info.version = {4, 1, 9};
  const std::string entry = (scripts.path() / "probe_entry.py").string();
  const std::string guard = (scripts.path() / "guard.py").string();
  EXPECT_EQ(launch_argv(info, scripts, {false}, launch),
            (std::vector<std::string>{"/b", "-b", "--factory-startup", "-noaudio", "-Y", "--verbose", "3",
                                      "-t", "3", "--python-exit-code", "86", "--python", guard, "/s.blend",
                                      "--python", entry, "--", "/f/request.json"}));
  info.version = {4, 2, 0};
  launch.threads = 0;
  EXPECT_EQ(launch_argv(info, scripts, {true}, launch),
            (std::vector<std::string>{"/b", "-b", "--factory-startup", "-noaudio", "-y", "--offline-mode",
                                      "--verbose", "3", "--python-exit-code", "86", "/s.blend", "--python",
                                      entry, "--", "/f/request.json"}));
  info.version = {5, 0, 0};
  const std::vector<std::string> argv = launch_argv(info, scripts, {true}, launch);
  EXPECT_NE(std::find(argv.begin(), argv.end(), "cycles.*,render"), argv.end());
  EXPECT_EQ(std::find(argv.begin(), argv.end(), "--verbose"), argv.end());
}

TEST(ProgressTail, WaitsForWholeLinesAndSkipsNonsense) {
  const TempFolder folder;
  const fs::path file = folder.path() / "progress.jsonl";
  ProgressTail tail(file);
  std::vector<std::string> seen;
  const auto collect = [&](const ProgressEvent& event) { seen.push_back(event.what); };
  EXPECT_FALSE(tail.poll(collect));
  std::ofstream stream(file);
  stream << R"({"phase":"bake","what":"a","done":1,"total":2})"
         << "\nnonsense\n[1]\n{\"what\":7}\n{\"what\":" << std::flush;
  EXPECT_TRUE(tail.poll(collect));
  EXPECT_FALSE(tail.poll(collect));
  stream << "\"b\"}\n" << std::flush;
  EXPECT_TRUE(tail.poll(collect));
  EXPECT_EQ(seen, (std::vector<std::string>{"a", "b"}));
}

TEST(PrivateEnvironment, KeepsBytecodeOnlyWhereAskedTo) {
  const auto value = [](const auto& changes, const std::string& name) -> std::optional<std::string> {
    for (const auto& [key, text] : changes)
      if (key == name) return text.value_or("unset");
    return std::nullopt;
  };
  const auto without = private_environment("/t/launch");
  EXPECT_EQ(value(without, "PYTHONDONTWRITEBYTECODE"), "1");
  EXPECT_EQ(value(without, "PYTHONPYCACHEPREFIX"), std::nullopt);
  const auto with = private_environment("/t/launch", "/t/bytecode");
  EXPECT_EQ(value(with, "PYTHONDONTWRITEBYTECODE"), "unset");
  EXPECT_EQ(value(with, "PYTHONPYCACHEPREFIX"), "/t/bytecode");
}

}  // namespace
}  // namespace rnmbake
