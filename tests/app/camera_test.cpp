#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

/// The camera of the example: a first run that takes reference images, the management of what it has stored, a second
/// run that monitors.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Answer runExample(const Folder& folder, const std::string& out, const std::string& tables,
                  const std::string& more = {}) {
  std::string setup = textOf(PROBEWRIGHT_SOURCE_DIR "/examples/setups/camera-tnc640.toml");
  const std::string control = "type = \"TNC640\"\n";
  if (!tables.empty()) setup.insert(setup.find(control) + control.size(), "tables = \"" + tables + "\"\n");
  return probewright({"run", "examples/programs/camera.h", "--setup", folder.file("camera.toml", setup + more), "--out",
                      (folder / out).string(), "--quiet"});
}

std::vector<double> states(const std::filesystem::path& results) {
  std::vector<double> found;
  const json all = json::parse(textOf(results));
  for (const json& cycle : all["cycles"])
    for (const json& result : cycle["results"])
      found.push_back(result["value"]);
  return found;
}

TEST(CameraCommand, ListsAndChangesWhatRunsHaveStored) {
  const Folder folder;
  const Answer first = runExample(folder, "out", "");
  ASSERT_EQ(first.exit, 0) << first.errors;
  EXPECT_THAT(states(folder / "out/results.json"), ElementsAre(1, 1)) << "the last reference image is like the others";

  const Answer all = probewright({"camera", (folder / "out").string()});
  EXPECT_EQ(all.exit, 0) << all.errors;
  EXPECT_THAT(all.output, HasSubstr("CAMERA.SETUP  images: 10  reference images: 10  error images: 0  areas: 1"));
  EXPECT_THAT(all.output, HasSubstr("CAMERA.CLAMP  images: 3  reference images: 3"));

  const Answer changed = probewright({"camera", (folder / "out").string(), "setup", "--keys",
                                      "SELECT IMAGE 2; DELETE IMAGE; SELECT IMAGE 5; REFERENCE IMAGE; ERROR IMAGE"});
  EXPECT_EQ(changed.exit, 0) << changed.errors;
  EXPECT_THAT(changed.output, Not(HasSubstr("CAMERA.SETUP.0002.PNG")));
  EXPECT_THAT(changed.output, HasSubstr("CAMERA.SETUP.0005.PNG  error"));
  EXPECT_EQ(textOf(folder / "out/CAMERA.SETUP.0002.PNG"), "") << "the file is gone";
  EXPECT_NE(textOf(folder / "out/results.json"), "") << "what else the run has left stays";

  // The folder is still that of a run: the next one may begin from it and write into it.
  const Answer second = runExample(folder, "out", (folder / "out").string());
  ASSERT_EQ(second.exit, 0) << second.errors;
  EXPECT_THAT(states(folder / "out/results.json"), ElementsAre(1, 1)) << "8 references, two more are taken";
  const Answer clamped = runExample(folder, "crowded", (folder / "out").string(),
                                    "\n[[fixture]]\nname = \"spanner\"\npose = { x = 10, y = 25, z = -580, c = 35 }\n"
                                    "[[fixture.feature]]\nshape = \"box\"\nsize = [90, 18, 10]\n");
  ASSERT_EQ(clamped.exit, 1) << clamped.errors << "what is seen beside the reference images is a verdict";
  EXPECT_EQ(states(folder / "crowded/results.json").at(0), 2);
}

TEST(CameraCommand, SaysWhatIsWrong) {
  const Folder folder;
  const Answer nothing = probewright({"camera", (folder / "none").string()});
  EXPECT_EQ(nothing.exit, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("there is no folder"));
  folder.file("A.TXT", "");
  const Answer empty = probewright({"camera", (folder / "").string()});
  EXPECT_EQ(empty.exit, 0);
  EXPECT_THAT(empty.output, HasSubstr("There are no camera images"));
  const Answer missing = probewright({"camera", (folder / "").string(), "OS"});
  EXPECT_EQ(missing.exit, 2);
  EXPECT_THAT(missing.errors, HasSubstr("there is no monitoring point \"OS\""));
}

TEST(CameraCommand, RefusesKeysThatThereAreNot) {
  const Folder folder;
  ASSERT_EQ(runExample(folder, "out", "").exit, 0);
  const std::string before = textOf(folder / "out/CAMERA.SETUP.VSC");
  for (const char* keys : {"JUMP", "CONFIGURE; DRAW AREA 0 0 999 5; SAVE AND BACK"})
    EXPECT_EQ(probewright({"camera", (folder / "out").string(), "CAMERA.SETUP", "--keys", keys}).exit, 2) << keys;
  EXPECT_EQ(textOf(folder / "out/CAMERA.SETUP.VSC"), before);
}

}  // namespace
}  // namespace probewright::app::testing
