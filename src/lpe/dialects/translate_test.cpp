#include "lpe/dialects/translate.h"

#include <gtest/gtest.h>

#include <iostream>

namespace lightsieve::lpe::dialects {
namespace {

TEST(TranslateScratch, Print) {
    const char* texts[] = {"C.*", "C<RD>L", "C[DSV]L", "C[DSV][DSVOB].*", "C[LO]", "CB",
                           "C<RS[^'coat']>.*", "C<RS'coat'>.*", "CV.*", "C[DSV]A",
                           "C<L.'key'>", "C(D|S)?L", "CD{2,4}L", "C.'hero'.*", "C.* - CL", "CD*L", "C<RS[^'coat''sheen']>L", "C[^D]L"};
    for (const char* text : texts)
        for (const Dialect* to : dialects()) {
            Diagnostics diagnostics;
            const auto out = translate(text, {}, arnold_dialect(), *to, diagnostics);
            std::cout << text << " -> " << to->name << ": ";
            if (!out) { std::cout << diagnostics.render() << "\n"; continue; }
            std::cout << out->text << (out->exact ? "" : "   LOSSY");
            if (out->lost) std::cout << " lost: " << print_path(*out->lost);
            if (out->added) std::cout << " added: " << print_path(*out->added);
            for (auto w : out->exact_without) std::cout << " [without " << without_name(w) << "]";
            for (const auto& note : out->notes) std::cout << " (" << note << ")";
            std::cout << "\n";
        }
}

}  // namespace
}  // namespace lightsieve::lpe::dialects
