#include <fmt/format.h>

#include <array>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice feedChoices[] = {{0, "at the feed rate Q396"}, {1, "at machine rapid traverse"}};
constexpr Choice trackChoices[] = {{0, "do not orient"}, {1, "orient the spindle before each probing"}};
constexpr Choice interruptChoices[] = {{0, "never"}, {1, "after every inspection cycle"}};

constexpr Parameter parameters441[] = {
    {.name = "Q396",
     .address = 396,
     .meaning = "feed rate of the positioning moves",
     .kind = ValueKind::Feed,
     .minimum = 0,
     .feedWords = control::onTNC640},
    option(397, "Q397", "pre-positioning", feedChoices),
    option(399, "Q399", "tracking of the probe", trackChoices),
    option(400, "Q400", "interrupt and show the results", interruptChoices),
};

constexpr std::array words = {
    OwnWords{"FAST PROBING", "Schnelles Antasten", "Быстрое измерение", "Snabb avkänning", "快速探测",
             "Szybkie próbkowanie"},
    OwnWords{"Sets positioning feed, tracking and interruption for all touch probe cycles that follow, until the end "
             "of the program. On the iTNC 530 a function of feature content level 2.",
             "Setzt Positioniervorschub, Nachführung und Unterbrechung für alle folgenden Tastsystemzyklen bis zum "
             "Programmende. Auf der iTNC 530 eine Funktion von Feature Content Level 2.",
             "Задаёт подачу позиционирования, слежение и прерывание для всех следующих циклов щупа до конца программы. "
             "На iTNC 530 функция уровня FCL 2.",
             "Sätter positioneringsmatning, spårning och avbrott för alla följande avkännarcykler till programmets "
             "slut. På iTNC 530 en funktion i Feature Content Level 2.",
             "为其后所有测头循环设定定位进给、跟踪和中断，直到程序结束。在 iTNC 530 上为 FCL 2 功能。",
             "Ustawia posuw pozycjonowania, nadążanie i przerwanie dla wszystkich następnych cykli sondy do końca "
             "programu. Na iTNC 530 funkcja poziomu FCL 2."},
    OwnWords{"after every inspection cycle", "nach jedem Prüfzyklus", "после каждого цикла контроля",
             "efter varje kontrollcykel", "每个检测循环后", "po każdym cyklu kontroli"},
    OwnWords{"at machine rapid traverse", "im Maschinen-Eilgang", "на ускоренном ходу станка",
             "med maskinens snabbtransport", "以机床快速移动", "na biegu szybkim maszyny"},
    OwnWords{"at the feed rate Q396", "mit dem Vorschub Q396", "с подачей Q396", "med matningen Q396", "以进给率 Q396",
             "z posuwem Q396"},
    OwnWords{"do not orient", "nicht orientieren", "не ориентировать", "orientera inte", "不定向", "nie orientować"},
    OwnWords{"feed rate of the positioning moves", "Vorschub der Positionierbewegungen", "подача позиционирования",
             "matning för positioneringsrörelser", "定位运动的进给率", "posuw ruchów pozycjonowania"},
    OwnWords{"interrupt and show the results", "unterbrechen und Ergebnisse zeigen", "прервать и показать результаты",
             "avbryt och visa resultaten", "中断并显示结果", "przerwać i pokazać wyniki"},
    OwnWords{"never", "nie", "никогда", "aldrig", "从不", "nigdy"},
    OwnWords{"orient the spindle before each probing", "Spindel vor jedem Antasten orientieren",
             "ориентировать шпиндель перед каждым касанием", "orientera spindeln före varje avkänning",
             "每次触测前主轴定向", "orientować wrzeciono przed każdym dotknięciem"},
    OwnWords{"pre-positioning", "Vorpositionieren", "предварительное позиционирование", "förpositionering", "预定位",
             "pozycjonowanie wstępne"},
    OwnWords{"tracking of the probe", "Nachführen des Tasters", "слежение щупа", "spårning av avkännaren",
             "测头跟踪定向", "nadążanie sondy"},
};

constexpr CycleDefinition definition = {
    .number = 441,
    .name = "441",
    .title = "FAST PROBING",
    .family = CycleFamily::Special,
    .summary =
        "Sets positioning feed, tracking and interruption for all touch probe cycles that follow, until the end of the "
        "program. On the iTNC 530 a function of feature content level 2.",
    .parameters = parameters441,
    .results = {},
    .words = words,
};

void run(Context& context, const Arguments&) {
  auto& overrides = context.control().overrides;
  const Control& control = context.control();
  double feed = context.q(396);
  const bool rapid = context.arguments().number(396) >= largest;  // FMAX
  if (const double limit = control.parameters.maxTouchFeed; control.isTNC640() && !rapid && feed > limit) {
    context.warn(fmt::format("Q396 = {:.0f} mm/min is limited to {:.0f} mm/min (maxTouchFeed)", feed, limit));
    feed = limit;
  }
  if (feed > 0) overrides.positioningFeed = feed;
  overrides.machineRapid = context.option(397) == 1;
  // The older control tracks only where its machine parameter has it prepared.
  overrides.track = context.option(399) == 1 && (control.isTNC640() || control.parameters.mp6165);
  if (context.option(399) == 1 && !*overrides.track) {
    context.warn("Q399 = 1 has no effect: MP6165 does not allow the probe to be turned to the touches");
  }
  overrides.interrupt = context.option(400) == 1;
}

}  // namespace

extern const Entry cycle441 = {.definition = definition,
                               .conditions = {.uses = Uses::Nothing, .under = Transformed::Any, .featureLevel = 2},
                               .run = run};

}  // namespace probewright::cycles::heidenhain
