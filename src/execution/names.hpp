#pragma once

/// The instruction set and the words of each language by their plain names, everywhere in this room.
namespace probewright::language {
namespace klartext {}
namespace sinumerik {}
namespace din_iso {}
}  // namespace probewright::language

namespace probewright::execution {
using namespace language;

namespace klartext {
using namespace language::klartext;
}
namespace sinumerik {
using namespace language::sinumerik;
}
namespace din_iso {
using namespace language::din_iso;
}
}  // namespace probewright::execution
