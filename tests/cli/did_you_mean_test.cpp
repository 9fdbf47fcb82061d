// A word that is close to one that is known is answered with it; any other is not.
#include <catch2/catch.hpp>
#include <fstream>

#include "program.hpp"

using namespace halfspace::testing;

TEST_CASE("did you mean: keys, values, options, subcommands, names") {
  const Place place;
  const std::string cube = scene("vkcube.ptf.xz");
  std::ofstream(place.path / "key.toml") << "[tile_walker]\ntile_sise = 8\n";
  std::ofstream(place.path / "value.toml") << "[setup]\nfill_rule = \"topleft\"\n";
  const std::string in = place.path.string() + "/";
  struct Case {
    std::string arguments;
    const char* meant;
  };
  for (const auto& [arguments, meant] : std::initializer_list<Case>{
           {"run " + cube + " --set tile_walker.tile_sise=8", "'tile_walker.tile_size'"},
           {"run " + cube + " --set memroy.latency=8", "'memory.latency'"},
           {"run " + cube + " --set setup.fill_rule=topleft", "'top_left'"},
           {"run " + cube + " --set hi_z.enabled=ture", "'true'"},
           {"config --config " + in + "key.toml", "'tile_walker.tile_size'"},
           {"config --config " + in + "value.toml", "'top_left'"},
           {"retime x --fidelity sampeld", "'sampled'"},
           {"run " + cube + " --fidelty rtl", "'--fidelity'"},
           {"run " + cube + " --fidelty=rtl", "'--fidelity'"},
           {"run " + cube + " --Quads", "'--quads'"},
           {"run " + cube + " -quads", "'--quads'"},
           {"run " + cube + " --fidelity recurence", "'recurrence'"},
           {"run " + cube + " --fidelity RTL", "'rtl'"},
           {"ledger " + cube + " --fidelity funcional", "'functional'"},
           {"run " + cube + " --core fsat", "'fast'"},
           {"run " + cube + " --reference exat", "'exact'"},
           {"run " + cube + " --sort front_to_back", "'front-to-back'"},
           {"run " + cube + " --fidelity recurrence --stall suorce:1:2", "'source'"},
           {"bench speed " + cube + " --without lvmpipe", "'llvmpipe'"},
           {"bench speed " + cube + " --depth unorm42", "'unorm24'"},
           {"info synthetic:one_trinagle", "'one_triangle'"},
           {"run synthetic:randon_122", "'random_122'"},
           {"stress --family slivers", "'sliver'"},
           {"stress --engine libary:x", "'library'"},
           {"stress --engine reference:barycentrics", "'barycentric'"},
           {"stress --engine wrong:no_tpo", "'no_top'"},
           {"rnu " + cube, "'run'"},
           {"leger " + cube, "'ledger'"},
           {"--versoin", "'--version'"},
           {"bench sped", "'speed'"},
           {"bench hi_z", "'hi-z'"},
       }) {
    const std::string sentence = std::string("(did you mean ") + meant + "?)";
    CAPTURE(arguments);
    check_error(place.run(arguments), {sentence.c_str()});
  }
}

TEST_CASE("did you mean: nothing is guessed that is not close") {
  const Place place;
  const std::string cube = scene("vkcube.ptf.xz");
  for (const std::string& arguments : std::initializer_list<std::string>{
           "run " + cube + " --set nonsense=8", "run " + cube + " --set tile_walker.tile_size=large",
           "run " + cube + " --nonsense", "run " + cube + " --fidelity guess", "run " + cube + " --core x",
           "info synthetic:nonsense", "nonsense", "bench nonsense", "run", "run nothing.ptf"}) {
    CAPTURE(arguments);
    const Outcome outcome = place.run(arguments);
    check_error(outcome, {"halfspace: "});
    CHECK(outcome.err.find("did you mean") == std::string::npos);
  }
}
