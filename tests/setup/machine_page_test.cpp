#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "control/journal.hpp"
#include "machine/links.hpp"
#include "machine/machine_file.hpp"
#include "records/run_info.hpp"
#include "reports/report.hpp"
#include "setup/machine_drawing.hpp"
#include "setup/scene.hpp"
#include "support/virtual_world.hpp"

/// The page of a machine. web/test/machine.test.mjs opens what is written here and compares the poses of its links.
namespace probewright::setup {
namespace {

using nlohmann::json;
using testing_support::place;
using testing_support::positions;

namespace fs = std::filesystem;

const fs::path samples = PROBEWRIGHT_MACHINE_PAGES;

void write(const std::string& name, const std::string& text) {
  fs::create_directories(samples);
  std::ofstream(samples / name) << text;
}

/// Where the links of a machine are, by another way than its forward kinematics: the chain, element by element, as a
/// product of exponentials of 4 x 4 matrices that is summed as a series.
Eigen::Matrix4d poseBySeries(const machine::MachineDescription& machine, const machine::AxisPositions& q,
                             const machine::Link& link) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < link.elements; ++i) {
    const machine::ChainElement& element = chainOf(machine, link)[i];
    Eigen::Matrix4d twist = Eigen::Matrix4d::Zero();
    double amount = q[*element.axis];
    if (machine.axes[*element.axis].kind == machine::AxisKind::Linear) {
      twist.block<3, 1>(0, 3) = element.direction;
    } else {
      const Vector3& w = element.direction;
      twist.block<3, 3>(0, 0) << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
      twist.block<3, 1>(0, 3) = -w.cross(element.point);
      amount = radiansFromDegrees(amount);
    }
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), sum = term;
    for (int k = 1; k <= 60; ++k) {
      term = term * twist * (amount / k);
      sum += term;
    }
    pose = pose * sum;
  }
  return pose;
}

TEST(MachinePage, IsWrittenForTheBrowser) {
  const std::map<std::string, machine::AxisPositions> places = {
      {"mill3", positions({120, -80, -200})},
      {"mill4-table", positions({150, -60, -300, 35})},
      {"mill5-table-table", positions({-100, 90, -250, 35, -50})},
      {"mill5-head-table", positions({200, -150, -300, 40, 65})},
      {"mill5-head-head", positions({300, 200, -400, -30, 75})},
      {"lathe2c", positions({180, 300, 25})},
  };
  json expected = json::object();
  for (const std::string& name : machine::readyMadeMachines()) {
    Diagnostics diagnostics;
    const auto world = readMachineWorld(name, diagnostics);
    ASSERT_TRUE(world) << name;
    EXPECT_TRUE(diagnostics.empty() && world->remarks.empty()) << name << " is a machine as ISO 841 has it";
    EXPECT_FALSE(world->truth.bodies.empty()) << name;
    const machine::MachineDescription& machine = world->truth.machine;
    write(name + ".html", reports::machinePage(machineSceneOf(world->truth), name, {}));
    const machine::AxisPositions& q = places.at(name);
    json links = json::array();
    for (const auto& [chain, kind, end] :
         {std::tuple("table", machine::Link::Chain::Table, machine.tableChain.size()),
          std::tuple("spindle", machine::Link::Chain::Spindle, machine.spindleChain.size())}) {
      for (std::size_t elements = 1; elements <= end; ++elements) {
        const machine::Link link{kind, elements};
        const Eigen::Matrix4d pose = poseBySeries(machine, q, link);
        EXPECT_TRUE(baseFromLink(machine, q, link).matrix().isApprox(pose, 1e-12)) << name;
        links.push_back(
            {{"chain", chain}, {"elements", elements}, {"pose", std::vector<double>(pose.data(), pose.data() + 16)}});
      }
    }
    json axes = json::object();
    for (std::size_t i = 0; i < machine.axes.size(); ++i)
      axes[machine.axes[i].name] = q[i];
    const Vector3 tip = (baseFromTable(machine, q).inverse() * baseFromSpindle(machine, q)) * Vector3(0, 0, -100);
    expected[name] = {{"axes", axes}, {"links", links}, {"tip", {tip.x(), tip.y(), tip.z()}}};
  }
  write("expected.json", expected.dump());
}

TEST(MachinePage, OfAReportIsWrittenForTheBrowser) {
  Diagnostics diagnostics;
  auto world = readMachineWorld("mill5-table-table", diagnostics);
  ASSERT_TRUE(world);
  world->truth.tools.push_back(testing_support::idealProbe());
  testing_support::place(world->truth, simulation::Box({-60, -40, -600}, {60, 40, -540}));
  simulation::VirtualMachine machine(std::move(world->truth));
  machine.insertTool({1, {}});
  machine.move(positions({40, 20, -300, 0, 0}), machine::Feed::rapidTraverse());
  machine.move(positions({40, 20, -300, 30, 60}), machine::Feed::at(5000));
  machine.move(positions({-90, 60, -350, 30, 60}), machine::Feed::at(5000));
  const reports::Scene scene = sceneOf(control::Journal(), machine.truth(), machine.path());
  records::RunInfo run;
  run.axes = machine.description().axes;
  write("report.html", reports::reportHtml(control::Journal(), run, scene));
  json links = json::array();
  for (const auto& [chain, kind, end] :
       {std::tuple("table", machine::Link::Chain::Table, 2), std::tuple("spindle", machine::Link::Chain::Spindle, 3)}) {
    for (int elements = 1; elements <= end; ++elements) {
      const machine::Link link{kind, static_cast<std::size_t>(elements)};
      const Eigen::Matrix4d pose = poseBySeries(machine.description(), machine.position(), link);
      const Eigen::Matrix4d onTable =
          poseBySeries(machine.description(), machine.position(), tableLink(machine.description())).inverse() * pose;
      links.push_back({{"chain", chain},
                       {"elements", elements},
                       {"base", std::vector<double>(pose.data(), pose.data() + 16)},
                       {"table", std::vector<double>(onTable.data(), onTable.data() + 16)}});
    }
  }
  write("report.json", links.dump());
}

TEST(MachinePage, HoldsNoTextThatCouldBecomeMarkup) {
  reports::MachineScene scene;
  scene.machine.name = "</script><script>alert(1)</script>\xff";
  const std::string page = reports::machinePage(scene, "a<b.toml", {"<i>"});
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script>\\u003cscript>alert(1)"), std::string::npos);
  EXPECT_TRUE(reports::isMachinePage(page));
  EXPECT_FALSE(reports::isMachinePage("<!doctype html><html><head><title>mine</title>"));
}

TEST(MachinePage, NamesAxesThatGoAgainstIso841) {
  const auto remarks = [](const std::string& chains) {
    const std::string axes =
        "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linear\"\nminimum = -9\nmaximum = 9\n"
        "[[axis]]\nname = \"C\"\nkind = \"rotary\"\nmodulo = true\n";
    write("turned.toml", axes + chains);
    Diagnostics diagnostics;
    const auto world = readMachineWorld((samples / "turned.toml").string(), diagnostics);
    EXPECT_TRUE(world);
    std::string text;
    for (const Diagnostic& remark : world ? world->remarks : Diagnostics())
      text += format(remark) + "\n";
    return text;
  };
  const std::string x = "axis = \"X\"\ndirection = ", c = "axis = \"C\"\ndirection = ";
  EXPECT_EQ(remarks("[[table_chain]]\n" + c + "[0, 0, -1]\n[[spindle_chain]]\n" + x + "[1, 0, 0]\n"), "");
  EXPECT_EQ(remarks("[[spindle_chain]]\n" + c + "[0, 0, 1]\n[[table_chain]]\n" + x + "[-1, 0, 0]\n"), "");
  // A nutating axis leans by 45 degrees.
  EXPECT_EQ(remarks("[[spindle_chain]]\n" + c + "[0, 1, 1]\n[[table_chain]]\n" + x + "[-1, 0, 0]\n"), "");
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  using ::testing::Not;
  EXPECT_THAT(remarks("[[table_chain]]\n" + c + "[0, 0, 1]\n[[spindle_chain]]\n" + x + "[1, 0, 0]\n"),
              AllOf(HasSubstr("with C going to plus"), HasSubstr("here it is the opposite"), Not(HasSubstr("with X"))));
  EXPECT_THAT(remarks("[[table_chain]]\n" + c + "[0, 0, -1]\n[[table_chain]]\n" + x + "[1, 0, 0]\n"),
              AllOf(HasSubstr("with X going to plus"), HasSubstr("moves towards +X"), Not(HasSubstr("with C"))));
  EXPECT_THAT(remarks("[[spindle_chain]]\n" + c + "[1, 0, 0]\n[[spindle_chain]]\n" + x + "[1, 0, 0]\n"),
              AllOf(HasSubstr("with C going to plus"), Not(HasSubstr("opposite"))));
}

TEST(MachinePage, ShowsWhatLiesOnTheTableWhereThatIsAskedFor) {
  simulation::Truth truth = testing_support::perfectWorld();
  truth.bodies.push_back({"nose", machine::headLink(truth.machine),
                          std::make_shared<simulation::Box>(Vector3(-40, -40, -10), Vector3(40, 40, 60)),
                          Pose::Identity()});
  place(truth, simulation::Box({-20, -20, 0}, {20, 20, 30}), translation({0, 0, -500}), "vice");
  place(truth, simulation::Box({-300, -200, -60}, {300, 200, 0}), translation({0, 0, -500}), "table");
  truth.solids.back().ofMachine = true;
  const auto names = [](const reports::MachineScene& scene) {
    std::vector<std::string> found;
    for (const auto& body : scene.bodies)
      found.push_back(body.mesh.name);
    return found;
  };
  EXPECT_EQ(names(machineSceneOf(truth)), (std::vector<std::string>{"nose", "table"}));
  EXPECT_EQ(names(machineSceneOf(truth, Drawn::WhatLiesOnTheTableToo)),
            (std::vector<std::string>{"nose", "vice", "table"}));
}

}  // namespace
}  // namespace probewright::setup
