#include "linuxcnc/interpreter_bench.hpp"

/// The folder of OUT of a program that LinuxCNC runs: before the program, between programs, and after one that was
/// killed.
namespace probewright::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class OutputOnLinuxCnc : public AsInterpreter {
protected:
  /// A word for the scripts: the set of files that lies in the folder, "nothing", or what is wrong with it.
  static constexpr const char* looks = R"(
import hashlib, json
def lies(folder='out'):
    try:
        with open(folder + '/.probewright.json', 'rb') as file: text = file.read()
    except FileNotFoundError:
        return 'nothing'
    for name, checksum in json.loads(text)['files'].items():
        with open(folder + '/' + name, 'rb') as file:
            if hashlib.sha256(file.read()).hexdigest() != checksum: return 'damaged ' + name
    return hashlib.sha256(text).hexdigest()
)";
  bool isThere(const std::string& name) const { return std::filesystem::exists(session_.outside() / name); }
};

TEST_F(OutputOnLinuxCnc, AFolderThatCannotBeWrittenIsRefusedBeforeAnythingMoves) {
  session_.write("setup.toml", setup("TNC640", world, 1200));
  session_.write("top.h", top());
  atTheDesk(std::string(keeps) + call(world) + R"(
fresh()
def refused(name, what):
    desk.messages.clear()
    desk.status.poll()
    before = list(desk.status.position)
    begin('top.h')
    desk.until('a refusal', lambda s: any(what in message for message in desk.messages))
    idle()
    desk.tell(name, list(desk.status.position) == before, *sorted(os.listdir('out') if os.path.isdir('out') else []))
os.mkdir('out')
os.chmod('out', 0o555)
refused('locked', 'cannot write into this folder: Permission denied')
os.chmod('out', 0o755)
os.rmdir('out')
with open('out', 'w') as file: file.write('mine')
refused('file', 'a file has its name')
os.remove('out')
run('top.h', 'done')
)");
  EXPECT_EQ(told("locked"), "True") << output;
  EXPECT_EQ(told("file"), "True");
  ASSERT_TRUE(results("done").is_object()) << output;
  EXPECT_EQ(touches(results("done")).size(), 3U) << "afterwards it can be written";
}

/// What LinuxCNC has no place for lasts if the setup's tables are the folder of OUT, from the first program on.
TEST_F(OutputOnLinuxCnc, IsWhereTheNextProgramBeginsFrom) {
  std::string next = setup("TNC640", world, 1200);
  next.insert(next.find("[part]"), "tables = \"out\"\n");
  session_.write("setup.toml", next);
  std::string typo = next;
  typo.replace(typo.find("\"out\""), 5, "\"uot\"");
  session_.write("typo.toml", typo);
  session_.write("top.h", top());
  std::string row20 = top();
  row20.replace(row20.find("Q305=+1"), 7, "Q305=+20");
  session_.write("row.h", row20);
  std::filesystem::copy(std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "tests/linuxcnc/world/canvas.py",
                        session_.outside() / "canvas.py");
  session_.write("screen.py", R"(
import sys
import gcode
from canvas import Canvas
exec(compile(open(sys.argv[1]).read(), sys.argv[1], 'exec'))
canvas = Canvas()
result, line = gcode.parse('top.h', canvas, 'G21', '')
print('desk: drawn', int(result <= gcode.MIN_ERROR), canvas.moves, flush=True)
)");
  output = session_.command("env INI_FILE_NAME=mill.ini /usr/bin/python3 screen.py '" +
                            (session_.source() / "linuxcnc/interpreter/probewright_preview.py").string() + "'");
  const std::vector<double> drawn = session_.told(output, "drawn");
  ASSERT_EQ(drawn.size(), 2U) << output;
  EXPECT_EQ(drawn[0], 1) << "the preview begins without tables too: " << output;
  EXPECT_GT(drawn[1], 5);
  EXPECT_FALSE(isThere("out")) << "a preview leaves nothing";

  atTheDesk(std::string(keeps) + call(world) + R"(
import shutil
fresh()
begin('row.h')
written()
idle()
shutil.copytree('out', 'first')
fresh()
os.remove('out/results.json')
begin('top.h')
written()
idle()
desk.messages.clear()
shutil.copy('typo.toml', 'setup.toml')
begin('top.h')
desk.until('a refusal', lambda s: any('there is no folder' in message for message in desk.messages))
idle()
)");
  for (const char* folder : {"first", "out"}) {
    EXPECT_THAT(text(std::string(folder) + "/PRESET.PR"), ContainsRegex("\n *20 [^\n]*-250\\.2")) << folder << output;
  }
  EXPECT_THAT(output, ContainsRegex("desk: message [^\n]*there is no folder \"[^\n]*uot\""));
}

TEST_F(OutputOnLinuxCnc, HoldsTheFilesBeforeOrTheFilesAfterWhenProbewrightIsKilled) {
  session_.write("setup.toml", setup("TNC640", world, 1200));
  std::string ini = text("mill.ini");
  ini.replace(ini.find("[TRAJ]"), 6, "[TRAJ]\nNO_FORCE_HOMING = 1");
  session_.write("mill.ini", ini);
  session_.write("top.h", top());
  atTheDesk(std::string(keeps) + looks + call(world) + R"(
import time
def process():
    end = time.monotonic() + 60
    while time.monotonic() < end:
        try: return engine()
        except RuntimeError: pass
def alive(number):
    try:
        with open(f'/proc/{number}/stat') as file: return file.read().split()[2] != 'Z'
    except (FileNotFoundError, ProcessLookupError): return False
def once():
    desk.mdi('G53 G0 Z0')
    fresh()
    begin('top.h')
once()
written()
idle()
def killed(name, wait):
    before = lies()
    once()
    number = process()
    wait(number)
    end = 'killed' if alive(number) else 'over'
    os.kill(number, signal.SIGKILL) if end == 'killed' else None
    while alive(number): time.sleep(0.001)
    after = lies()
    idle()
    kind = 'old' if after == before else after if ' ' in after or after == 'nothing' else 'new'
    desk.tell(name, end, kind, 'as it was' if lies() == after else 'changed later')
def writes(number):
    while alive(number) and not os.path.exists('.out.probewright'): pass
def way(n):
    def wait(number):
        writes(number)
        time.sleep(0.001 * 2 ** n)
    return wait
killed('begun', lambda number: None)
killed('moving', lambda number: moving(desk))
killed('probing', lambda number: probing(desk))
for n in range(10): killed(f'writing{n}', way(n))

# A machine that is not ready changes nothing either.
once()
desk.until('results', lambda s: os.path.exists('out/results.json') and not os.path.exists('.out.probewright'))
idle()
desk.mode(linuxcnc.MODE_MANUAL)
desk.command.teleop_enable(0)
desk.taken()
desk.until('the joints', lambda s: s.motion_mode == linuxcnc.TRAJ_MODE_FREE)
desk.command.unhome(-1)
desk.until('no homed axis', lambda s: not any(s.homed))
with open('out/PRESET.PR') as file: preset = file.read()
desk.messages.clear()
begin('top.h')
desk.until('a refusal', lambda s: any('axes of LinuxCNC are not homed' in message for message in desk.messages))
idle()
with open('out/PRESET.PR') as file: desk.tell('refused', file.read() == preset, os.path.exists('out/results.json'))
desk.tell('litter', *[name for name in os.listdir('.') if 'probewright' in name], 'is all')
)",
            400);
  for (const char* name : {"begun", "moving", "probing"})
    EXPECT_EQ(told(name), "killed old as it was") << name << output;
  for (int n = 0; n < 10; ++n) {
    const std::string name = "writing" + std::to_string(n);
    EXPECT_THAT(told(name), ContainsRegex("(killed|over) (old|new) as it was")) << name;
  }
  EXPECT_EQ(told("refused"), "True False") << output;
  EXPECT_EQ(told("litter"), "is all") << output;
}

}  // namespace
}  // namespace probewright::testing
