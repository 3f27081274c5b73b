// Packed arrays; see scene/testing/fuzz_targets.h.
#include <cstddef>
#include <cstdint>

#include "scene/testing/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    lightsieve::testing::fuzz_packed({reinterpret_cast<const char*>(data), size});
    return 0;
}
