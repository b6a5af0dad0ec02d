// Blocks parsed and interpreted per second, beside LinuxCNC's stand-alone interpreter rs274 on equivalent programs.
//
// Every program has a million blocks, or runs a loop of a million blocks, and is read from a file. The host evaluates
// every word, keeps the position, and in the benchmarks named "Written" prints each move into a stream that goes
// nowhere, as rs274 prints its canonical calls. rs274's time is that of the whole process; RsStart says what of it is
// start-up.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "execution/evaluation.hpp"
#include "execution/interpreter.hpp"
#include "language/klartext/program.hpp"
#include "language/sinumerik/program.hpp"

namespace {

using namespace probewright;
using namespace probewright::execution;
using namespace probewright::language;
namespace fs = std::filesystem;

constexpr int million = 1'000'000;

enum class Dialect { Rs274, Sinumerik, Klartext };
enum class Kind { Empty, Moves, Formulas, Loop };

/// A point of the surface that is milled; three decimals as posts write them.
std::array<double, 3> point(int i) { return {0.05 * (i % 2000), 0.1 * (i / 2000), 5 * std::sin(0.01 * i)}; }

void writeMoves(Dialect dialect, std::ofstream& out) {
  for (int i = 0; i < million; ++i) {
    const auto [x, y, z] = point(i);
    const char* feed = i % 50 == 0 ? " F1500" : "";
    if (dialect == Dialect::Klartext) {
      out << fmt::format("{} L X{:+.3f} Y{:+.3f} Z{:+.3f}{}\n", i + 1, x, y, z, feed);
    } else {
      out << fmt::format("N{} G1 X{:.3f} Y{:.3f} Z{:.3f}{}\n", i + 1, x, y, z, feed);
    }
  }
}

void writeFormulas(Dialect dialect, std::ofstream& out) {
  for (int i = 0; i < million / 3; ++i) {
    const auto [x, y, z] = point(i);
    switch (dialect) {
      case Dialect::Rs274:
        out << fmt::format("#1=[{:.3f}+#2*0.5]\n#3=[{:.3f}+SIN[#1]]\nG1 X#1 Y#3 F1000\n", x, y);
        break;
      case Dialect::Sinumerik:
        out << fmt::format("R1={:.3f}+R2*0.5\nR3={:.3f}+SIN(R1)\nG1 X=R1 Y=R3 F1000\n", x, y);
        break;
      case Dialect::Klartext:
        out << fmt::format("Q1 = {:.3f} + Q2 * 0.5\nQ3 = {:.3f} + SIN Q1\nL X+Q1 Y+Q3 F1000\n", x, y);
        break;
    }
  }
}

/// Six blocks a pass.
void writeLoop(Dialect dialect, std::ofstream& out) {
  const int passes = million / 6;
  switch (dialect) {
    case Dialect::Rs274:
      out << "#1=0\no100 while [#1 LT " << passes
          << "]\n#1=[#1+1]\n#2=[#1*0.001]\n#3=[SQRT[#2]]\nG1 X#2 Y#3 F1000\no100 endwhile\n";
      break;
    case Dialect::Sinumerik:
      out << "R1=0\nWHILE R1<" << passes << "\nR1=R1+1\nR2=R1*0.001\nR3=SQRT(R2)\nG1 X=R2 Y=R3 F1000\nENDWHILE\n";
      break;
    case Dialect::Klartext:
      out << "Q1 = 0\nLBL 1\nQ1 = Q1 + 1\nQ2 = Q1 * 0.001\nQ3 = SQRT Q2\nL X+Q2 Y+Q3 F1000\nFN 12: IF +Q1 LT +"
          << passes << " GOTO LBL 1\n";
      break;
  }
}

/// The program, written once and removed at the end.
const std::string& file(Dialect dialect, Kind kind) {
  struct Files {
    std::array<std::array<std::string, 4>, 3> names;
    ~Files() {
      for (const auto& kinds : names) {
        for (const auto& name : kinds)
          if (!name.empty()) fs::remove(name);
      }
    }
  };
  static Files files;
  std::string& name = files.names[static_cast<std::size_t>(dialect)][static_cast<std::size_t>(kind)];
  if (name.empty()) {
    constexpr const char* endings[] = {"ngc", "mpf", "h"};
    const std::string leaf = fmt::format("language_benchmark_{}_{}.{}", ::getpid(), static_cast<int>(kind),
                                         endings[static_cast<std::size_t>(dialect)]);
    name = (fs::temp_directory_path() / leaf).string();
    std::ofstream out(name);
    if (dialect == Dialect::Klartext) out << "BEGIN PGM BENCH MM\n";
    if (kind == Kind::Moves) writeMoves(dialect, out);
    if (kind == Kind::Formulas) writeFormulas(dialect, out);
    if (kind == Kind::Loop) writeLoop(dialect, out);
    out << (dialect == Dialect::Klartext ? "END PGM BENCH MM\n" : dialect == Dialect::Sinumerik ? "M30\n" : "M2\n");
  }
  return name;
}

class NoLibrary : public ProgramLibrary {
public:
  Result<std::shared_ptr<Program>> open(std::string_view, const Program*) override { return fail("none"); }
  bool exists(std::string_view, const Program*) override { return false; }
};

double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A control that knows numbered variables and moves.
class BenchHost : public Host {
public:
  explicit BenchHost(std::FILE* out) : out_(out) {}

  Value read(const VariableRef& variable, Evaluation& evaluation) override { return slot(variable, evaluation); }
  void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) override {
    slot(variable, evaluation) = std::get<double>(value);
  }
  bool isDefined(const VariableRef&, Evaluation&) override { return true; }
  Value call(std::string_view, std::span<const Value>) override { return 0.0; }
  void execute(const Instruction& instruction, Evaluation& evaluation) override {
    const auto* move = std::get_if<Move>(&instruction);
    if (move == nullptr) return;
    for (const Word& word : evaluation.words(move->words)) {
      if (word.address >= 'X' && word.address <= 'Z') position_[word.address - 'X'] = evaluation.number(word.value);
    }
    feed_ = evaluation.numberOr(move->feed, feed_);
    ++moves;
    if (out_ != nullptr) {
      fmt::print(out_, "{:6} STRAIGHT_FEED({:.4f}, {:.4f}, {:.4f}, {:.4f})\n", moves, position_[0], position_[1],
                 position_[2], feed_);
    }
  }
  bool beginBlock(const Program&, const Block&) override {
    if ((++blocks_ & 0xffffU) == 0) mostMegabytes = std::max(mostMegabytes, residentMegabytes());
    return true;
  }
  void enter(const Program&, const CallProgram*, Evaluation*) override {}
  void leave(const Program&) override {}

  std::uint64_t moves = 0;
  double mostMegabytes = 0;

private:
  double& slot(const VariableRef& variable, Evaluation& evaluation) {
    return numbers_.at(static_cast<std::size_t>(evaluation.number(variable.index[0])));
  }

  std::FILE* out_;
  std::uint64_t blocks_ = 0;
  std::array<double, 2000> numbers_{};
  std::array<double, 3> position_{};
  double feed_ = 0;
};

std::shared_ptr<Program> open(Dialect dialect, Kind kind) {
  if (dialect == Dialect::Klartext) return language::klartext::KlartextProgram::open(file(dialect, kind)).value();
  return language::sinumerik::SinumerikProgram::open(file(dialect, kind)).value();
}

void interpret(benchmark::State& state, Dialect dialect, Kind kind, bool written) {
  file(dialect, kind);
  std::FILE* out = written ? std::fopen("/dev/null", "w") : nullptr;
  std::uint64_t blocks = 0;
  double growth = 0;
  for (auto _ : state) {
    const double before = residentMegabytes();
    NoLibrary library;
    BenchHost host(out);
    InterpreterOptions options;
    options.stepLimit = 0;
    const RunResult result = Interpreter(library, host, options).run(open(dialect, kind));
    if (result.end != RunEnd::Finished) {
      state.SkipWithError(format(result.diagnostics.front()).c_str());
      break;
    }
    blocks += result.blocks;
    growth = std::max(growth, host.mostMegabytes - before);
  }
  if (out != nullptr) std::fclose(out);
  state.counters["blocks"] = benchmark::Counter(static_cast<double>(blocks), benchmark::Counter::kIsRate);
  state.counters["grown_MB"] = growth;
}

void parseOnly(benchmark::State& state, Dialect dialect, Kind kind) {
  file(dialect, kind);
  std::uint64_t blocks = 0;
  for (auto _ : state) {
    const auto program = open(dialect, kind);
    Block block;
    Diagnostics diagnostics;
    for (BlockPosition at = program->begin(); program->parse(at, block, diagnostics); at = block.next)
      ++blocks;
    if (!diagnostics.empty()) state.SkipWithError(format(diagnostics.front()).c_str());
  }
  state.counters["blocks"] = benchmark::Counter(static_cast<double>(blocks), benchmark::Counter::kIsRate);
}

/// Processor time of all processes that were started and have ended.
double childSeconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void rs274(benchmark::State& state, Kind kind) {
  const std::string command = "rs274 -g " + file(Dialect::Rs274, kind) + " > /dev/null 2> /dev/null";
  for (auto _ : state) {
    const double before = childSeconds();
    if (std::system(command.c_str()) != 0) {
      state.SkipWithError("rs274 did not run the program to its end; it comes with the package linuxcnc-uspace");
      break;
    }
    state.SetIterationTime(childSeconds() - before);
  }
  state.counters["blocks"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * (kind == Kind::Empty ? 1 : million), benchmark::Counter::kIsRate);
}

#define PROBEWRIGHT_INTERPRET(language, kind)                                                                        \
  BENCHMARK_CAPTURE(interpret, language##kind, Dialect::language, Kind::kind, false)->Unit(benchmark::kMillisecond); \
  BENCHMARK_CAPTURE(interpret, language##kind##Written, Dialect::language, Kind::kind, true)                         \
      ->Unit(benchmark::kMillisecond)

BENCHMARK_CAPTURE(rs274, Start, Kind::Empty)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK_CAPTURE(rs274, Moves, Kind::Moves)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK_CAPTURE(rs274, Formulas, Kind::Formulas)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK_CAPTURE(rs274, Loop, Kind::Loop)->Unit(benchmark::kMillisecond)->UseManualTime();
PROBEWRIGHT_INTERPRET(Sinumerik, Moves);
PROBEWRIGHT_INTERPRET(Sinumerik, Formulas);
PROBEWRIGHT_INTERPRET(Sinumerik, Loop);
PROBEWRIGHT_INTERPRET(Klartext, Moves);
PROBEWRIGHT_INTERPRET(Klartext, Formulas);
PROBEWRIGHT_INTERPRET(Klartext, Loop);
BENCHMARK_CAPTURE(parseOnly, SinumerikMoves, Dialect::Sinumerik, Kind::Moves)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parseOnly, KlartextMoves, Dialect::Klartext, Kind::Moves)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parseOnly, SinumerikFormulas, Dialect::Sinumerik, Kind::Formulas)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parseOnly, KlartextFormulas, Dialect::Klartext, Kind::Formulas)->Unit(benchmark::kMillisecond);

}  // namespace
