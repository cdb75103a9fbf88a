// Embeds a plan: calls it as a function, then runs it, listens to it, changes it and stops it.
#include <cstdio>
#include <vagus/embed/plan_run.hpp>
#include <vagus/toolbox/core.hpp>

using namespace vagus;

namespace {

// As another plan would use it: inputs in, outputs out. In virtual time, so without waiting.
int call_it(const embed::LoadedPlan& plan) {
    const Result<embed::Called> called =
        embed::call(plan, {{"times", plan::Value(int64_t{2})}}, {.clock = embed::Clock::Virtual});
    if (!called.ok()) {
        std::fprintf(stderr, "greet: %s\n", called.error().what.c_str());
        return 1;
    }
    std::printf("called: it greeted %lld times\n",
                static_cast<long long>(called.value().outputs.at("said").integer()));
    return 0;
}

// In real time. The pause is made shorter before the start; after the second greeting it is enough.
int run_it(const embed::LoadedPlan& plan) {
    embed::PlanRun run(plan);
    const Status written = run.write("pause", plan::Value(0.01));
    if (!written.ok()) return 1;
    run.listen([&run](const plan::TraceEvent& event) {
        const auto* logged = std::get_if<plan::TextLogged>(&event.what);
        if (!logged) return;
        std::printf("%s\n", logged->text.c_str());
        if (run.read("said").value() == plan::Value(int64_t{2})) run.abort();
    });
    const run::Ended ended = run.run();
    std::printf("run: %s\n", std::string(plan::name_of(ended.result)).c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const embed::LoadedPlan plan =
        embed::LoadedPlan::from_file(argc > 1 ? argv[1] : "Greet.plan.json", library);
    std::fputs(plan.report().c_str(), stderr);
    if (!plan.ok()) return 2;
    const int called = call_it(plan);
    return called != 0 ? called : run_it(plan);
}
