// SPDX-License-Identifier: Apache-2.0
#include "signals.h"
#include "verb.h"

#include "vdbounce/base/error.h"

#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <thread>

#include <tbb/global_control.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace vdbounce::tool {
namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

int fail(int exitCode, std::string message)
{
    // One line, whatever a message quotes.
    for (char& c : message) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    std::cerr << "vdbounce: error: " << message << std::endl;
    return exitCode;
}

// The verb (and the word after it, as in "emit box") that the user typed, for errors.
std::string typedVerb(const CLI::App& app)
{
    std::string verb = "vdbounce";
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
        at = at->get_subcommands().front();
        verb += " " + at->get_name();
    }
    return verb;
}

void addCommonOptions(CLI::App& verb, CommonOptions& common)
{
    for (CLI::App* inner : verb.get_subcommands([](CLI::App*) { return true; })) addCommonOptions(*inner, common);
    verb.add_option("--threads", common.threads, "Threads to use; 0 for all cores")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    verb.add_flag("--json", common.json, "Print one JSON object on stdout");
    verb.add_flag("--quiet", common.quiet, "Print nothing but errors");
}

// Arrays of a megabyte and more go back to the system when they are let go. Left to itself malloc soon keeps them, and
// a conversion's peak grows by a quarter.
void giveBackLargeArrays()
{
#ifdef __GLIBC__
    constexpr int kLargeArray = 1 << 20; // bytes
    mallopt(M_MMAP_THRESHOLD, kLargeArray);
#endif
}

int run(int argc, char** argv)
{
    giveBackLargeArrays();
    CLI::App app("Collides very large particle sets with sparse level sets in OpenVDB grids.", "vdbounce");
    CommonOptions common;
    app.set_version_flag("--version", VDBOUNCE_VERSION);
    app.require_subcommand(1);
    app.footer("Lengths are world units, or voxels with the suffix vx. Vectors are x,y,z. 'vdbounce VERB --help' has "
               "an example of each.");
    addMesh2ls(app, common);
    addMake(app, common);
    addCsg(app, common);
    addBlobs(app, common);
    addInfo(app, common);
    addSample(app, common);
    addEmit(app, common);
    addConvert(app, common);
    addCollide(app, common);
    addRedistance(app, common);
    addRender(app, common);
    addSlice(app, common);
    addBench(app, common);
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) addCommonOptions(*verb, common);

    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& request) { // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        const std::string verb = typedVerb(app);
        const auto rest = app.remaining(/*recurse=*/true);
        if (error.get_exit_code() == int(CLI::ExitCodes::RequiredError) && !rest.empty()) {
            return fail(kExitUsage, verb + ": there is no '" + rest.front() + "'; see '" + verb + " --help'");
        }
        return fail(kExitUsage, verb + ": " + error.what() + "; see '" + verb + " --help'");
    } catch (const Error& error) {
        return fail(error.exitCode(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(kExitFailed, typedVerb(app) + ": out of memory; use larger voxels or fewer particles");
    } catch (const std::exception& error) {
        return fail(kExitFailed,
                    typedVerb(app) + ": " + error.what() + "; this is a defect of vdbounce, please report it");
    }
}

} // namespace

int threadsUsed(const CommonOptions& common)
{
    return common.threads > 0 ? common.threads : int(std::max(1u, std::thread::hardware_concurrency()));
}

void runWith(const CommonOptions& common, const std::function<void()>& body)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threadsUsed(common)));
    body();
}

} // namespace vdbounce::tool

int main(int argc, char** argv)
{
    vdbounce::tool::handleInterrupts();
    return vdbounce::tool::run(argc, argv);
}
