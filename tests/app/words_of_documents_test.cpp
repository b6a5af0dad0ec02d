#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include "app/block_world.hpp"
#include "app/program.hpp"

/// The tables of words in the documents against what a run does with these words.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// "90, 101 to 103" as numbers.
std::vector<int> numbersOf(const std::string& cell) {
  std::vector<int> numbers;
  const std::regex expression("([0-9]+)(?: to ([0-9]+))?");
  for (std::sregex_iterator each(cell.begin(), cell.end(), expression), end; each != end; ++each) {
    const int first = std::stoi((*each)[1]), last = (*each)[2].matched ? std::stoi((*each)[2]) : first;
    for (int number = first; number <= last; ++number)
      numbers.push_back(number);
  }
  return numbers;
}

/// The rows of the table of M functions in docs/klartext.md: what is said of which numbers.
std::map<std::string, std::vector<int>> rowsOfMFunctions() {
  std::istringstream page(textOf(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/klartext.md"));
  std::map<std::string, std::vector<int>> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) inside = line == "## M functions";
    const std::size_t middle = line.find(" | ");
    if (!inside || !line.starts_with("| ") || middle == std::string::npos) continue;
    const std::string what = line.substr(middle + 3);
    rows[what.substr(0, what.find_first_of(":,|"))] = numbersOf(line.substr(2, middle - 2));
  }
  return rows;
}

/// A run of blocks with these M functions.
Answer withFunctions(const Folder& folder, const std::vector<int>& functions, const std::vector<std::string>& options) {
  std::string program = "BEGIN PGM M MM\nTOOL CALL 1 Z S500\nL Z+50 R0 FMAX\n";
  for (const int function : functions)
    program += "L IX+1 R0 F100 M" + std::to_string(function) + "\n";
  std::vector<std::string> words = {"run",     folder.file("M.H", program + "END PGM M MM\n"),
                                    "--setup", folder.file("m.toml", blockSetup()),
                                    "--out",   (folder / "out").string()};
  words.insert(words.end(), options.begin(), options.end());
  return probewright(words);
}

TEST(DocumentedWords, MFunctionsDoWhatTheirRowsSay) {
  const Folder folder;
  auto rows = rowsOfMFunctions();
  const std::vector<int> accepted = rows["accepted"], skipped = rows["named as skipped "];
  ASSERT_GT(accepted.size(), 15U);
  ASSERT_GT(skipped.size(), 10U);
  const Answer passes = withFunctions(folder, accepted, {"--strict"});
  EXPECT_EQ(passes.exit, 0) << passes.output << passes.errors;
  EXPECT_THAT(passes.output, Not(HasSubstr("skipped")));
  // All together, so that naming one does not hide the next; those of the machine tool builder are named, too.
  std::vector<int> named = skipped;
  named.insert(named.end(), {21, 51, 300});
  const Answer tells = withFunctions(folder, named, {});
  EXPECT_EQ(tells.exit, 0) << tells.output << tells.errors;
  for (const int function : named) {
    SCOPED_TRACE(function);
    EXPECT_TRUE(std::regex_search(tells.output, std::regex("M" + std::to_string(function) + "\\b[^\n]*skipped")))
        << tells.output;
  }
  EXPECT_EQ(withFunctions(folder, {named.back()}, {"--strict", "--quiet"}).exit, 3);
  // What is carried out passes without a word where nothing else is needed for it.
  const Answer carried = withFunctions(
      folder, {3, 4, 5, 6, 7, 8, 9, 13, 14, 19, 20, 94, 126, 127, 129, 130, 136, 137, 141, 143, 145}, {"--strict"});
  EXPECT_EQ(carried.exit, 0) << carried.output << carried.errors;
  EXPECT_THAT(carried.output, Not(HasSubstr("skipped")));
}

/// A block with each of the words that docs/sinumerik.md names in its rows on what is not carried out and on what has
/// no effect. A word that comes into one of these rows needs a block here.
const std::map<std::string, std::string> blockOf = {
    {"SETINT", "SETINT(1) UP"},
    {"OS", "OS[X]=1"},
    {"OSP1", "OSP1[X]=10"},
    {"TRANSMIT", "TRANSMIT"},
    {"TRACYL", "TRACYL(40)"},
    {"TCARR", "TCARR=1"},
    {"OFFN", "OFFN=1"},
    {"FXS", "FXS[X]=1"},
    {"GEOAX", "GEOAX(1,X)"},
    {"CALLPATH", "CALLPATH(\"/_N_WKS_DIR\")"},
    {"G25", "G25 X0"},
    {"G26", "G26 X10"},
    {"WALCS1", "WALCS1"},
    {"G5", "G5"},
    {"G7", "G7"},
    {"G810", "G810"},
    {"G829", "G829"},
    {"$P_EXTFRAME", "$P_EXTFRAME=CTRANS(X,1)"},
    {"$P_TRAFRAME", "$P_TRAFRAME=CTRANS(X,1)"},
    {"$P_CYCFRAME", "$P_CYCFRAME=CTRANS(X,1)"},
    {"$P_GFRAME", "$P_GFRAME=CTRANS(X,1)"},
    {"$P_CHBFRMASK", "$P_CHBFRMASK=0"},
    {"$P_NCBFRMASK", "$P_NCBFRMASK=0"},
    {"SOFT", "SOFT"},
    {"FFWON", "FFWON"},
    {"COMPCAD", "COMPCAD"},
    {"CTOL", "CTOL=0.01"},
    {"G60", "G60"},
    {"G64", "G64"},
    {"ADIS", "ADIS=1"},
    {"FINEA", "FINEA[X]"},
    {"CYCLE832", "CYCLE832(0.01,1)"},
    {"GROUP_BEGIN", "GROUP_BEGIN(0,\"A\",0,0)"},
    {"GROUP_END", "GROUP_END(0,0)"},
};

/// The words in capitals of the row that begins so.
std::vector<std::string> wordsOfRow(const std::string& begin) {
  const std::string page = textOf(std::string(PROBEWRIGHT_SOURCE_DIR) + "/docs/sinumerik.md");
  const std::size_t at = page.find("\n| " + begin);
  EXPECT_NE(at, std::string::npos) << begin;
  const std::string row = page.substr(at + 3, page.find(" | ", at + 3) - at - 3);
  std::vector<std::string> words;
  const std::regex expression("[$A-Z][A-Z_0-9]*[A-Z0-9]");
  for (std::sregex_iterator each(row.begin(), row.end(), expression), end; each != end; ++each)
    if (each->str() != "3D") words.push_back(each->str());
  return words;
}

/// A run of the blocks of these words on a SINUMERIK.
Answer withWords(const Folder& folder, const std::vector<std::string>& words, const std::vector<std::string>& options) {
  std::string program;
  for (const std::string& word : words) {
    const auto block = blockOf.find(word);
    if (block == blockOf.end()) {
      ADD_FAILURE() << "no block for " << word;
      continue;
    }
    program += block->second + "\n";
  }
  std::vector<std::string> arguments = {"run",     folder.file("W.MPF", program + "M30\n"),
                                        "--setup", folder.file("w.toml", "[control]\ntype = \"840Dsl\"\n"),
                                        "--out",   (folder / "out").string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return probewright(arguments);
}

TEST(DocumentedWords, OfSinumerikAreNamedOrPassAsTheirRowSays) {
  const Folder folder;
  const std::vector<std::string> named = wordsOfRow("everything that would change where the tool is");
  ASSERT_GT(named.size(), 15U);
  const Answer tells = withWords(folder, named, {});
  EXPECT_EQ(tells.exit, 0) << tells.errors;
  for (const std::string& word : named)
    EXPECT_THAT(tells.errors, HasSubstr(word + " is not carried out"));
  EXPECT_EQ(withWords(folder, {named.back()}, {"--strict", "--quiet"}).exit, 3);
  std::vector<std::string> passing = wordsOfRow("other words: dynamics");
  const std::vector<std::string> cycles = wordsOfRow("CYCLE832");
  passing.insert(passing.end(), cycles.begin(), cycles.end());
  ASSERT_GT(passing.size(), 8U);
  std::erase(passing, "CUST");  // CUST_...: programs of the machine tool builder
  const Answer passes = withWords(folder, passing, {"--strict"});
  EXPECT_EQ(passes.exit, 0) << passes.errors;
  EXPECT_EQ(passes.errors, "");
}

}  // namespace
}  // namespace probewright::app::testing
