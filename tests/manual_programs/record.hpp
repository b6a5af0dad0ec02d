#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "base/file.hpp"
#include "records/results.hpp"
#include "support/heidenhain_bench.hpp"

/// Keeps what runs leave behind, for scripts/record-outputs.
namespace probewright::testing_support {

/// A bench whose runs leave program, results, files and screens in the folder $PROBEWRIGHT_RECORD, if that is set: in a
/// folder for each test, another for each of its runs.
struct RecordedBench : Bench {
  using Bench::Bench;

  Ran runBare(const std::string& blocks, const std::string& unit = "MM") const {
    Ran ran = Bench::runBare(blocks, unit);
    if (const char* folder = std::getenv("PROBEWRIGHT_RECORD")) keep(folder, blocks, ran);
    return ran;
  }
  Ran run(const std::string& blocks, const std::string& unit = "MM") const {
    return runBare("TOOL CALL 1 Z\n" + blocks, unit);
  }

private:
  static void keep(const std::filesystem::path& record, const std::string& blocks, const Ran& ran) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = fmt::format("{}.{}", test->test_suite_name(), test->name());
    std::ranges::replace(name, '/', '-');
    static std::map<std::string, int> runs;
    const std::filesystem::path folder = record / name / std::to_string(++runs[name]);
    std::filesystem::create_directories(folder);
    std::map<std::string, std::string> files = ran.outcome.files;
    files["program.h"] = blocks;
    files["results.json"] = records::resultsText(ran.outcome.journal, ran.outcome.info);
    std::string& said = files["said.txt"];
    for (const Diagnostics& all : {ran.outcome.diagnostics, ran.outcome.result.diagnostics}) {
      for (const Diagnostic& each : all)
        said += format(each) + "\n";
    }
    for (const auto& [file, text] : files) {
      const auto written = writeFileAtomically(folder / file, text);
      ASSERT_TRUE(written) << format(written.error());
    }
  }
};

}  // namespace probewright::testing_support
