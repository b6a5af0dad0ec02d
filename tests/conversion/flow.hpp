#pragma once

#include <cstdlib>

#include "conversion/twins.hpp"
#include "metrology/fits.hpp"

/// Random programs with flow of every kind.
///
/// PROBEWRIGHT_PROGRAMS: how many programs each test tries, PROBEWRIGHT_SEED: which ones; for long runs by hand.
namespace probewright::testing_support {

inline int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

/// A slightly leaning block with a hole and a pin, whose touches tell where they were made.
struct World {
  PlantedPart part;
  double hole = 30, pin = 20;

  explicit World(Dice& dice) : part(plant(dice, ControlKind::TNC640, 0.4, 0.3)) {
    const Pose lean = part.machineFromPart * pose({0, 0, 0}, {dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 0});
    part.bench.part(simulation::Box({-70, -70, -30}, {70, 20, 0}), lean);
    part.bench.part(simulation::Ring(hole / 2, 20, -30), part.machineFromPart * pose({0, 45, 0}, {0, 0, 0}));
    part.bench.part(simulation::RoundBar(pin / 2, -30, 0), part.machineFromPart * pose({60, 60, 0}, {0, 0, 0}));
  }
  const Vector3& nominal() const { return part.nominal; }
};

inline ::testing::AssertionResult sameTouches(const Twin& one, const Twin& other) {
  // On a circle both controls touch at other places and in another order: what tells is the circle.
  const auto touches = [](const Twin& twin) {
    std::vector<Vector3> found;
    // Where both stop in a cycle, the order of its touches decides what has been touched until then.
    const std::size_t last = twin.journal.cycles.size() - (twin.finished || twin.journal.cycles.empty() ? 0 : 1);
    for (const control::CycleRecord& cycle : std::span(twin.journal.cycles).first(last)) {
      std::vector<Vector2> points;
      for (const control::TouchRecord& touch : cycle.touches) {
        if (touch.outcome != "touched") continue;
        points.emplace_back(touch.latched[0], touch.latched[1]);
        if (cycle.touches.size() < 3) found.emplace_back(touch.latched[0], touch.latched[1], touch.latched[2]);
      }
      if (points.size() < 3) continue;
      const auto circle = metrology::fitCircle(points);
      if (circle) found.emplace_back(circle->shape.centre.x(), circle->shape.centre.y(), circle->shape.radius);
    }
    return found;
  };
  std::vector<Vector3> first = touches(one), second = touches(other);
  // A program without an end is stopped somewhere.
  const auto isEndless = [](const Twin& twin) { return twin.why.find("-limit") != std::string::npos; };
  if (isEndless(one) && isEndless(other)) {
    first.resize(std::min(first.size(), second.size()));
    second.resize(first.size());
  }
  for (std::size_t i = 0; i < std::max(first.size(), second.size()); ++i) {
    if (i < first.size() && i < second.size() && (first[i] - second[i]).norm() < exactly) continue;
    const auto at = [&](const std::vector<Vector3>& list) {
      return i < list.size() ? fmt::format("({:.6f} {:.6f} {:.6f})", list[i].x(), list[i].y(), list[i].z()) : "none";
    };
    return ::testing::AssertionFailure() << fmt::format("touch {} of {} and {}: {} and {}\n", i, first.size(),
                                                        second.size(), at(first), at(second))
                                         << one.text << "\n"
                                         << other.text;
  }
  return ::testing::AssertionSuccess();
}

/// The same touches, the same end, the same verdicts.
inline ::testing::AssertionResult runsTheSame(const Twin& original, const Twin& there) {
  if (original.finished != there.finished) {
    return ::testing::AssertionFailure() << original.why << " / " << there.why << "\n"
                                         << original.text << "\n"
                                         << there.text;
  }
  for (const auto& result : {sameTouches(original, there), sameOrigin(original, there)})
    if (!result) return result;
  const auto worst = [](const Twin& twin) {
    control::Verdict verdict = control::Verdict::None;
    for (const control::CycleRecord& cycle : twin.journal.cycles)
      verdict = std::max(verdict, cycle.verdict);
    return verdict;
  };
  const auto bad = [&](const Twin& twin) { return worst(twin) > control::Verdict::Good; };
  if (original.finished && bad(original) != bad(there)) {
    return ::testing::AssertionFailure() << "the verdicts differ\n" << original.text << "\n" << there.text;
  }
  return original.finished ? sameEnd(original, there) : ::testing::AssertionSuccess();
}

/// What a program is in a job.
struct Role {
  std::string name = "BENCH";
  bool called = false;             ///< by another program
  std::vector<std::string> calls;  ///< programs that it may call
};

/// A HEIDENHAIN program; a part of a job calls the programs `calls`.
class KlartextFlow {
public:
  KlartextFlow(Dice& dice, const World& world, Role role = {}) : dice_(dice), world_(world), role_(std::move(role)) {}

  std::string program() {
    for (int i = 1; i <= dice_.whole(2, 5); ++i)
      labels_.push_back(dice_.coin() ? fmt::format("{}", i) : fmt::format("\"PART{}\"", i));
    std::vector<std::string> unplaced = labels_;
    const int items = dice_.whole(10, 28), stopAt = dice_.whole(6, items);
    for (int i = 0; i < items || !unplaced.empty(); ++i) {
      if (i == stopAt && !role_.called) end();
      if (!unplaced.empty() && (i >= items || dice_.whole(0, 3) == 0)) {
        text_ += fmt::format("LBL {}\nQ90 = Q90 + 1\nFN 11: IF +Q90 GT +17 GOTO LBL 99\n", unplaced.back());
        unplaced.pop_back();
      } else {
        item();
      }
    }
    if (role_.called) ended_ = true;
    if (stopAt >= items || text_.find("LBL 99\nL Z") == std::string::npos) end();
    if (role_.called) {
      return fmt::format("BEGIN PGM {0} MM\nCC X+0 Y+0\n{1}LBL 99\nL Z+100 R0 FMAX\nEND PGM {0} MM\n", role_.name,
                         text_);
    }
    // Where a cycle leaves the probe is each control's own: all ways lead to one place at the end.
    const std::string shared = role_.calls.empty() ? "" : "Q150 = 1\nQR7 = 2\n";
    return klartextProgram(shared + "CC X+0 Y+0\nQ1 = 0\nQ2 = 1\nQ3 = 2\nQ90 = 0\n" + text_ +
                           "FN 9: IF +0 EQU +0 GOTO LBL 99\n");
  }

private:
  void end() {
    if (ended_) return;
    ended_ = true;
    text_ += fmt::format("LBL 99\nL Z+100 R0 FMAX\nL X+Q1 Y+Q2 FMAX\nL Z+Q3 FMAX M30\n");
  }
  std::string label() {
    return labels_[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(labels_.size()) - 1))];
  }
  int q() { return dice_.whole(1, 3); }

  void item() {
    static constexpr const char* comparisons[] = {"9: IF +Q{} EQU +{}", "10: IF +Q{} NE +{}", "11: IF +Q{} GT +{}",
                                                  "12: IF +Q{} LT +{}"};
    const int kind = dice_.whole(0, role_.calls.empty() && !role_.called ? 20 : 23);
    if (kind < 4) {
      text_ += fmt::format("Q{} = Q{} {} {}\n", q(), q(), dice_.coin() ? '+' : '-', dice_.whole(1, 3));
    } else if (kind < 8) {
      measure();
    } else if (kind < 11) {
      text_ += fmt::format(fmt::runtime("FN " + std::string(comparisons[dice_.whole(0, 3)]) + " GOTO LBL {}\n"), q(),
                           dice_.whole(0, 5), label());
    } else if (kind < 14) {
      text_ += fmt::format("CALL LBL {}\n", label());
    } else if (kind < 15) {
      text_ += fmt::format("CALL LBL {} REP {}\n", label(), dice_.whole(1, 3));
    } else if (kind < 17) {
      text_ += "LBL 0\n";
    } else if (kind < 18) {
      text_ += fmt::format("FN 9: IF +0 EQU +0 GOTO LBL {}\n", label());
    } else if (kind < 19) {
      text_ += fmt::format("L Z+{} R0 FMAX\nL X+Q{} Y-Q{} FMAX\n", 60 + dice_.whole(0, 20), q(), q());
    } else if (kind < 20) {
      text_ += "Q2 = Q160 * 0 + 1\n";
    } else if (kind < 21) {
      arcs();
    } else if (kind < 22 && !role_.calls.empty()) {
      text_ +=
          fmt::format("CALL PGM {}\n",
                      role_.calls[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(role_.calls.size()) - 1))]);
    } else {
      text_ += dice_.coin() ? fmt::format("Q150 = Q150 + {}\nQ{} = Q150\n", dice_.whole(0, 2), q())
                            : fmt::format("QR7 = Q150 - {}\nQ{} = QR7\n", dice_.whole(0, 2), q());
    }
  }

  /// From X10 Y0 to X10 Y-10 above the part; the centre may be one that another way has set.
  void arcs() {
    text_ += "L Z+80 R0 FMAX\nL X+10 Y+0 R0 FMAX\n";
    if (dice_.whole(0, 7) != 0) text_ += "CC X+0 Y+0\n";
    text_ += fmt::format("C X+0 Y+10 DR{} F2000\nL X+10 Y+0\n", dice_.coin() ? '+' : '-');
    text_ += fmt::format("CR X+0 Y+{0} R+{0} DR{1}\n", 10, dice_.coin() ? '+' : '-');
    text_ += fmt::format("L X+20 Y+0\n{}L X+20 Y-20\nCT X+30 Y-30\nL IX+1\n", dice_.coin() ? "RND R2\n" : "");
  }

  void measure() {
    const Vector3& n = world_.nominal();
    const auto place = [](double middle, int parameter, const char* function, double reach) {
      return fmt::format("{:+.4f} + {} ({} * Q{}) * {}", middle, function, 37, parameter, reach);
    };
    if (dice_.whole(0, 3) == 0) {
      const int cycle = dice_.coin() ? 421 : 412;
      const double nominal = world_.hole + (dice_.coin() ? 0.3 : 0);
      const bool limits = dice_.coin();
      Words words = {{cycle == 421 ? 273 : 321, n.x()},
                     {cycle == 421 ? 274 : 322, n.y() + 45},
                     {262, nominal},
                     {325, dice_.whole(0, 3) * 15},
                     {247, 90},
                     {261, n.z() - 6},
                     {320, 2},
                     {260, n.z() + 20},
                     {301, dice_.whole(0, 1)}};
      if (cycle == 421) {
        words = with(words, {{275, limits ? nominal + 0.2 : 0},
                             {276, limits ? nominal - 0.1 : 0},
                             {279, 0},
                             {280, 0},
                             {281, 0},
                             {309, 0},
                             {330, 0},
                             {423, 4},
                             {365, 1}});
      } else {
        words = with(words, {{305, 1},
                             {331, n.x()},
                             {332, n.y() + 45},
                             {303, 1},
                             {381, 0},
                             {382, 0},
                             {383, 0},
                             {384, 0},
                             {333, 0},
                             {423, 4},
                             {365, 1}});
      }
      text_ += probe(cycle, words);
      if (cycle == 412) text_ += "CYCL DEF 247 PRESET ~\n  Q339=+1\n";
      return;
    }
    const bool limits = dice_.coin();
    text_ += fmt::format("Q11 = {}\nQ12 = {}\n", place(n.x(), q(), "SIN", 50), place(n.y() - 30, q(), "COS", 25));
    text_ += fmt::format(
        "TCH PROBE 427 MEASURE ~\n  Q263=+Q11 ~\n  Q264=+Q12 ~\n  Q261={0:+.4f} ~\n  Q320=+{1} ~\n  Q272=+3 ~\n  "
        "Q267=-1 ~\n  Q260={2:+.4f} ~\n  Q281=+0 ~\n  Q288={3:+.4f} ~\n  Q289={4:+.4f} ~\n  Q309=+0 ~\n  Q330=+0\n",
        n.z(), dice_.whole(2, 5), n.z() + 20, limits ? n.z() + 0.3 : 0, limits ? n.z() - 0.2 : 0);
  }

  Dice& dice_;
  const World& world_;
  Role role_;
  std::vector<std::string> labels_;
  std::string text_;
  bool ended_ = false;
};

/// A SINUMERIK program.
class SinumerikFlow {
public:
  SinumerikFlow(Dice& dice, const World& world, Role role = {}) : dice_(dice), world_(world), role_(std::move(role)) {}

  std::string program() {
    struct Item {
      std::string text;
      bool jumps = false, repeats = false;
    };
    static constexpr const char* pool[] = {"PARTA", "PARTB", "PARTC"};
    std::vector<Item> items;
    std::vector<std::pair<std::size_t, std::string>> marks;
    const int count = dice_.whole(8, 22);
    for (int i = 0; i < count; ++i) {
      const int kind = dice_.whole(0, 11);
      Item item;
      if (kind < 3) {
        const std::string name = pool[dice_.whole(0, 2)];
        marks.emplace_back(items.size(), name);
        item.text = fmt::format("{}: R90=R90+1\nIF R90>18 GOTOF FINISH\n", name);
      } else if (kind < 5) {
        item.jumps = true;
      } else if (kind < 6) {
        item.repeats = true;
      } else {
        item.text = statement(2);
      }
      items.push_back(item);
    }
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].jumps && !marks.empty()) {
        const auto& [at, name] = marks[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(marks.size()) - 1))];
        text += fmt::format("IF {} {} {}\n", condition(), at > i ? "GOTOF" : "GOTOB", name);
      } else if (items[i].repeats && marks.size() > 1) {
        const auto first = static_cast<std::size_t>(dice_.whole(0, static_cast<int>(marks.size()) - 2));
        const auto& [at, name] = marks[first];
        // The end label is the first of its name behind the begin.
        if (dice_.coin() && at < i) {
          text += fmt::format("REPEAT {} P={}\n", name, dice_.whole(1, 2));
        } else if (marks[first + 1].second != name) {
          text += fmt::format("REPEAT {} {} P={}\n", name, marks[first + 1].second, dice_.whole(1, 4));
        }
      } else {
        text += items[i].text;
      }
    }
    if (role_.called) return fmt::format("PROC {}\n{}FINISH:\nM17\n", role_.name, text);
    return "DEF REAL PLACE\nG17 G90 G710 G40\nT1 M6 D1\nG54\nG0 Z100\nR1=0 R2=1 R3=2 R90=0\n" + text +
           "FINISH:\nTRANS\nG90 G0 Z100\nX=R1 Y=R2\nM30\n";
  }

private:
  int r() { return dice_.whole(1, 3); }
  std::string condition() {
    static constexpr const char* signs[] = {"==", "<>", ">", "<", ">=", "<="};
    const auto one = [&] { return fmt::format("R{}{}{}", r(), signs[dice_.whole(0, 5)], dice_.whole(0, 5)); };
    const int kind = dice_.whole(0, 5);
    if (kind == 0) return fmt::format("({}) AND ({})", one(), one());
    if (kind == 1) return fmt::format("({}) OR ({})", one(), one());
    if (kind == 2) return fmt::format("NOT ({})", one());
    return one();
  }

  std::string statements(int depth) {
    std::string text;
    for (int i = 0; i < dice_.whole(1, 3); ++i)
      text += statement(depth);
    return text;
  }

  std::string statement(int depth) {
    int kind = dice_.whole(depth > 0 ? 0 : 6, role_.calls.empty() ? 17 : 19);
    if (isCalm() && (kind == 5 || kind == 6 || kind == 7 || kind == 11)) kind = 8;
    const std::string loop = fmt::format("R{}", 40 + depth);
    switch (kind) {
      case 0:
        return fmt::format("IF {}\n{}ENDIF\n", condition(), statements(depth - 1));
      case 1:
        return fmt::format("IF {}\n{}ELSE\n{}ENDIF\n", condition(), statements(depth - 1), statements(depth - 1));
      case 2:
        return fmt::format("FOR {}=1 TO {}\n{}ENDFOR\n", loop, dice_.whole(0, 3), statements(depth - 1));
      case 3:
        return fmt::format("{0}=0\nWHILE {0}<{1}\n{0}={0}+1\n{2}ENDWHILE\n", loop, dice_.whole(0, 3),
                           statements(depth - 1));
      case 4:
        return fmt::format("{0}=0\nREPEAT\n{0}={0}+1\n{2}UNTIL {0}>={1}\n", loop, dice_.whole(0, 3),
                           statements(depth - 1));
      case 5:
        return fmt::format("IF {}\n{}ENDIF\n", condition(), dice_.coin() ? "G91\n" : "G0 G90 X=R1\n");
      case 6:
        return fmt::format("TRANS X={} Y={}\n", dice_.whole(-3, 3),
                           dice_.coin() ? std::string("R1") : std::to_string(dice_.whole(-2, 2)));
      case 7:
        return dice_.coin() ? "TRANS\n" : fmt::format("ATRANS X={}\n", dice_.whole(1, 2));
      case 8:
        return fmt::format("G0 Z{}\nX{} Y{}\n", 60 + dice_.whole(0, 20), dice_.whole(-3, 3), dice_.whole(-3, 3));
      case 9:
      case 10:
        return fmt::format("R{}=R{}{}{}\n", r(), r(), dice_.coin() ? '+' : '-', dice_.whole(1, 3));
      case 11:
        return dice_.coin() ? "ROT\n" : fmt::format("AROT Z{}\n", dice_.whole(-9, 9));
      case 12:
        return measureHole();
      case 17:
        return arcs();
      case 18:
        return fmt::format(
            "{}\n", role_.calls[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(role_.calls.size()) - 1))]);
      case 19:
        return fmt::format("R{}=R{}+PLACES[1]-2\n", r(), r());
      default:
        return measure();
    }
  }

  /// Most programs of a job leave modes and frames alone: what another program may have changed is listed.
  bool isCalm() { return (role_.called || !role_.calls.empty()) && dice_.whole(0, 9) != 0; }

  std::string arcs() {
    return fmt::format(
        "G90 G0 Z80\nX10 Y0\n{0} X0 Y10 I-10 J0 F2000\nG1 X10 Y0\n{0} X0 Y10 CR=10\nG1 X20 Y0{1}\nX20 Y-20\n"
        "G2 X30 Y-30 I=AC(30) J=AC(-20)\nG0 X=IC(1)\n",
        dice_.coin() ? "G2" : "G3", dice_.coin() ? " RND=2" : "");
  }

  std::string measure() {
    const Vector3& n = world_.nominal();
    const std::string x = fmt::format("{:.4f}+SIN(37*R{})*40", n.x(), r());
    const std::string y = fmt::format("{:.4f}+COS(37*R{})*20", n.y() - 30, r());
    const bool corrects = dice_.whole(0, 5) == 0;
    return fmt::format("G90 G0 Z{:.4f}\nG0 X={} Y={}\nG0 Z{:.4f}\n", n.z() + 40, x, y, n.z() + 8) +
           sinumerikCall("CYCLE978", {{"S_MVAR", corrects ? 100 : 0},
                                      {"S_KNUM", corrects ? 10001 : 0},
                                      {"S_PRNUM", 1},
                                      {"S_SETV", n.z()},
                                      {"S_FA", 8},
                                      {"S_TSA", dice_.coin() ? 9 : 0.5},
                                      {"S_MA", 3},
                                      {"S_MD", 2},
                                      {"S_NMSP", 1}}) +
           fmt::format("G0 Z{:.4f}\n", n.z() + 40) + (dice_.coin() ? "R3=_OVR[4]*0+R3\n" : "");
  }

  std::string measureHole() {
    const Vector3& n = world_.nominal();
    const int task = dice_.whole(0, 2);
    Named words = {{"S_MVAR", task == 0   ? 101
                              : task == 1 ? 201
                                          : 1},
                   {"S_KNUM", task == 0 ? 10001 : 0},
                   {"S_KNUM1", 0},
                   {"S_PRNUM", 1},
                   {"S_SETV", world_.hole},
                   {"S_FA", 5},
                   {"S_TSA", dice_.coin() ? 10 : 0.6},
                   {"S_STA1", dice_.whole(0, 3) * 10},
                   {"S_NMSP", 1}};
    if (task == 1) words.insert(words.end(), {{"S_TUL", 0.2}, {"S_TLL", -0.1}, {"_AMODE", 1}});
    return fmt::format("G90 G0 Z{:.4f}\nG0 X{:.4f} Y{:.4f}\nG0 Z{:.4f}\n", n.z() + 40, n.x(), n.y() + 45, n.z() - 6) +
           sinumerikCall("CYCLE977", words) + fmt::format("G0 Z{:.4f}\n", n.z() + 40);
  }

  Dice& dice_;
  const World& world_;
  Role role_;
};

}  // namespace probewright::testing_support
