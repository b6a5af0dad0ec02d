#include <gmock/gmock.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "study_ranks/study_bench.hpp"

/// What --keep writes, read with the library that other programs use.
namespace probewright::app::testing {
namespace {

struct Table {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

class KeptFile {
public:
  explicit KeptFile(const std::string& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  KeptFile(const KeptFile&) = delete;
  KeptFile& operator=(const KeptFile&) = delete;
  ~KeptFile() {
    if (file_ >= 0) H5Fclose(file_);
  }
  bool isOpen() const { return file_ >= 0; }

  Table table(const char* name) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT), space = H5Dget_space(set);
    hsize_t sizes[2] = {0, 1};
    H5Sget_simple_extent_dims(space, sizes, nullptr);
    Table table{sizes[0], sizes[1], std::vector<double>(sizes[0] * sizes[1])};
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data()), 0) << name;
    H5Sclose(space);
    H5Dclose(set);
    return table;
  }

  std::vector<int> numbers(const char* name) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<int> numbers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0) << name;
    H5Sclose(space);
    H5Dclose(set);
    return numbers;
  }

  std::vector<std::string> texts(const char* name) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT), space = H5Dget_space(set), type = H5Dget_type(set);
    std::vector<char*> read(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0) << name;
    const std::vector<std::string> texts(read.begin(), read.end());
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, read.data());
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(set);
    return texts;
  }

private:
  hid_t file_;
};

/// The cells of the lines of trials.csv after the heading; names here have no commas.
std::vector<std::vector<std::string>> linesOf(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    std::erase(line, '"');
    auto& cells = lines.emplace_back(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
  }
  return lines;
}

TEST(KeptTrials, HoldEveryValueOfEveryTrial) {
  const StudyBench bench;
  const Answer done = probewright(bench.words("700", "out", {"--keep", bench.path("kept/trials.h5")}));
  ASSERT_EQ(done.exit, 0) << done.errors;
  const KeptFile file(bench.path("kept/trials.h5"));
  ASSERT_TRUE(file.isOpen());
  const auto lines = linesOf(bench.text("out/trials.csv"));
  ASSERT_EQ(lines.size(), 701U);
  const std::vector<std::string> names = file.texts("result_names"), sources = file.texts("source_names");
  const Table inputs = file.table("sources"), results = file.table("results"), truths = file.table("truths");
  EXPECT_THAT(sources, ::testing::ElementsAre("clamping", "height"));
  ASSERT_EQ(inputs.rows, 700U);
  ASSERT_EQ(results.rows, 700U);
  ASSERT_EQ(results.columns, names.size());
  ASSERT_EQ(truths.columns, names.size());
  ASSERT_FALSE(names.empty());
  EXPECT_THAT(file.numbers("end"), ::testing::Each(0));
  EXPECT_THAT(file.numbers("why"), ::testing::Each(-1));
  const std::vector<int> numbers = file.numbers("trial");
  const auto columnOf = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(lines[0], name) - lines[0].begin());
  };
  for (std::size_t row = 0; row < 700; ++row) {
    const auto& cells = lines[row + 1];
    EXPECT_EQ(numbers[row], static_cast<int>(row));
    for (std::size_t i = 0; i < sources.size(); ++i)
      EXPECT_EQ(inputs.at(row, i), std::stod(cells[columnOf("source " + sources[i])]));
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_EQ(results.at(row, i), std::stod(cells[columnOf(names[i])])) << names[i];
      const std::size_t truth = columnOf("truth of " + names[i]);
      if (truth == cells.size()) {
        EXPECT_TRUE(std::isnan(truths.at(row, i))) << names[i];
      } else {
        EXPECT_EQ(truths.at(row, i), std::stod(cells[truth])) << names[i];
      }
    }
  }
}

TEST(KeptTrials, AreTheSameBytesOnAnyNumberOfRanks) {
  if (!hasMpi()) GTEST_SKIP() << "built without MPI";
  const StudyBench bench;
  for (const int ranks : {1, 2, 4}) {
    const std::string out = std::to_string(ranks);
    ASSERT_EQ(Launched(mpirun(ranks, bench.words("600", out, {"--keep", bench.path(out + ".h5")}))).wait(), 0);
    EXPECT_EQ(bench.text(out + ".h5"), bench.text("1.h5")) << ranks;
    EXPECT_EQ(bench.text(out + "/study.json"), bench.text("1/study.json")) << ranks;
  }
  EXPECT_GT(bench.text("1.h5").size(), 600 * 8U);
}

TEST(KeptTrials, TellAlarmsAndTheirReasons) {
  const StudyBench bench;
  // Far enough aside the probe comes to its end without a contact.
  const std::string far = bench.folder().file(
      "far.toml",
      "sensitivity = \"none\"\n[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"discrete\"\n"
      "values = [0, -15]\n");
  std::vector<std::string> words = bench.words("40", "out", {"--keep", bench.path("trials.h5")});
  *std::next(std::ranges::find(words, "--study")) = far;
  const Answer done = probewright(words);
  ASSERT_EQ(done.exit, 0) << done.errors;
  const KeptFile file(bench.path("trials.h5"));
  const auto lines = linesOf(bench.text("out/trials.csv"));
  const std::vector<int> ends = file.numbers("end"), why = file.numbers("why");
  const std::vector<std::string> reasons = file.texts("reasons");
  ASSERT_EQ(ends.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(ends[i], lines[i + 1][1] == "alarm" ? 1 : 0);
    EXPECT_EQ(why[i] < 0, ends[i] == 0);
  }
  EXPECT_THAT(ends, ::testing::Contains(1));
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_THAT(reasons[0], ::testing::HasSubstr("line 4"));
}

TEST(KeptTrials, NeverReplaceAnotherFile) {
  const StudyBench bench;
  const std::string mine = bench.folder().file("trials.h5", "mine\n");
  const Answer refused = probewright(bench.words("20", "out", {"--keep", mine}));
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("stays as it is"));
  EXPECT_EQ(bench.text("trials.h5"), "mine\n");
  const std::string kept = bench.path("kept.h5");
  EXPECT_EQ(probewright(bench.words("20", "out", {"--keep", kept})).exit, 0);
  EXPECT_EQ(probewright(bench.words("30", "out", {"--keep", kept})).exit, 0);
  EXPECT_EQ(KeptFile(kept).numbers("trial").size(), 30U);
}

/// A file larger than the process may write (4 kB) is to the library what a full disk is.
TEST(KeptTrials, SayThatThereIsNoRoom) {
  const StudyBench bench;
  std::vector<std::string> words = {"sh", "-c", "ulimit -f 8; trap '' XFSZ; exec \"$@\"", "sh", PROBEWRIGHT_PROGRAM};
  const std::vector<std::string> study = bench.words("5", "out", {"--keep", bench.path("trials.h5")});
  words.insert(words.end(), study.begin(), study.end());
  EXPECT_EQ(Launched(words).wait(), 2);
  EXPECT_FALSE(fs::exists(bench.path("trials.h5")));
  for (const auto& entry : fs::directory_iterator(fs::path(bench.path("x")).parent_path()))
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(::testing::HasSubstr(".new-")));
}

}  // namespace
}  // namespace probewright::app::testing
