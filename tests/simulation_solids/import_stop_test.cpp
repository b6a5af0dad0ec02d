#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <cerrno>

#include "simulation/cad_solid.hpp"
#include "simulation/import_cache.hpp"
#include "worlds.hpp"

/// A stop that is asked for in the middle of an import, in each of its phases.
namespace probewright::simulation {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::ScratchFolder;
using ::testing::SizeIs;

class StoppedImport : public ::testing::Test {
protected:
  StoppedImport() {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
    BRepFilletAPI_MakeFillet fillet(box);
    for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next())
      fillet.Add(3, TopoDS::Edge(edges.Current()));
    EXPECT_TRUE(writeStep(fillet.Shape(), part()));
  }

  std::filesystem::path part() const { return folder_ / "part.step"; }
  std::filesystem::path cache() const { return folder_ / "cache"; }
  std::vector<std::filesystem::path> kept() const {
    std::vector<std::filesystem::path> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(cache(), none))
      names.push_back(entry.path().filename());
    return names;
  }

  struct Told {
    std::vector<std::string> stages;
    Result<std::unique_ptr<Solid>> solid;
  };
  /// Imports the part, and asks for a stop as soon as something is told that holds `at`.
  Told read(const std::string& at, double seconds = 1800) {
    std::stop_source source;
    ImportOptions options;
    options.cache = cache();
    options.stop = source.get_token();
    options.patience = 0;
    options.seconds = seconds;
    std::vector<std::string> stages;
    options.progress = [&](const std::string& what) {
      stages.push_back(what.substr(0, what.find(',')));
      if (what.find(at) != std::string::npos) source.request_stop();
    };
    auto solid = readStep(part(), options);
    return {std::move(stages), std::move(solid)};
  }

  ScratchFolder folder_;
};

const std::string kNever = "\n";

TEST_F(StoppedImport, EndsInWhicheverPhaseItIs) {
  const std::vector<std::string> stages = read(kNever).stages;
  std::filesystem::remove_all(cache());
  for (const char* stage : {"reading the file", "building the part", "cutting the faces", "meshing the faces",
                            "preparing the faces", "making it ready"}) {
    EXPECT_THAT(stages, Contains(HasSubstr(stage)));
    const Told told = read(stage);
    ASSERT_FALSE(told.solid) << stage;
    EXPECT_THAT(format(told.solid.error()), HasSubstr("the import was interrupted")) << stage;
    EXPECT_THAT(told.stages.back(), HasSubstr(stage));
    // The child is gone.
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << stage;
    EXPECT_EQ(errno, ECHILD) << stage;
    // Only the last phase begins when there is something whole to keep.
    for (const std::filesystem::path& name : kept()) {
      EXPECT_STREQ(stage, "making it ready");
      EXPECT_EQ(name.extension(), ".part");
    }
  }
  // Whatever was kept is good, and what was not is kept now.
  EXPECT_TRUE(read(kNever).solid);
  EXPECT_THAT(kept(), SizeIs(1));
  EXPECT_TRUE(read(kNever, 0).solid);
}

TEST_F(StoppedImport, EndsAlsoWhereThePartIsInTheCache) {
  EXPECT_TRUE(read(kNever).solid);
  const Told told = read("making it ready", 0);
  ASSERT_FALSE(told.solid);
  EXPECT_THAT(format(told.solid.error()), HasSubstr("the import was interrupted"));
  EXPECT_THAT(kept(), SizeIs(1));
  EXPECT_TRUE(read(kNever, 0).solid);
}

TEST_F(StoppedImport, KeepsNothingOnceItIsStopped) {
  std::stop_source source;
  source.request_stop();
  const ImportCache kept(cache());
  kept.keep("key", std::string(100'000, 'x'), source.get_token());
  EXPECT_FALSE(kept.find("key"));
  EXPECT_THAT(this->kept(), IsEmpty());
}

TEST_F(StoppedImport, RemovesWhatAKilledRunHasLeftInTheCache) {
  const ImportCache kept(cache());
  std::filesystem::create_directories(cache());
  const auto file = [&](const std::string& name, std::chrono::minutes age) {
    std::ofstream(cache() / name) << "half";
    std::filesystem::last_write_time(cache() / name, std::filesystem::file_time_type::clock::now() - age);
  };
  file("old.part.123.0", std::chrono::minutes(20));
  file("young.part.124.0", std::chrono::minutes(0));
  file("mine.txt", std::chrono::minutes(20));
  kept.keep("key", "whole");
  EXPECT_THAT(this->kept(), ::testing::UnorderedElementsAre("key.part", "young.part.124.0", "mine.txt"));
}

}  // namespace
}  // namespace probewright::simulation
