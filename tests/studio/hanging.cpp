// A toolbox with what a person may write by mistake: code that never comes back, and code that
// dies.
#include <csignal>
#include <memory>

#include "toolbox/plugin.hpp"

namespace {

using namespace vagus;

class HangForever final : public run::Actor {
    void run(run::ActorContext&) override {
        for (volatile bool forever = true; forever;) {
        }
    }
};

class Crash final : public run::Actor {
    void run(run::ActorContext&) override { (void)std::raise(SIGSEGV); }
};

plan::Template named(const char* name, const char* help) {
    return {.name = name, .help = help, .icon = "M1 1h1", .outcomes = {{"Done", "never"}}};
}

toolbox::Plugin make(const toolbox::Parts&) {
    return {.name = "hanging",
            .help = "Mistakes.",
            .templates = {
                {named("HangForever", "Never comes back."),
                 [] { return std::make_unique<HangForever>(); },
                 {}},
                {named("Crash", "Dies."), [] { return std::make_unique<Crash>(); }, {}},
            }};
}

}  // namespace

VAGUS_TOOLBOX(make)
