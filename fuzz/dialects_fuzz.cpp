// Translations between dialects; see lpe/testing/fuzz_targets.h.
#include <cstddef>
#include <cstdint>

#include "lpe/testing/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    lightsieve::lpe::testing::fuzz_dialects({reinterpret_cast<const char*>(data), size});
    return 0;
}
