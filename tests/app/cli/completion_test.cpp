// Completions: in bash each command, option and closed set of values is offered; the scripts for zsh and fish are asked
// where these shells are installed.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "process.hpp"
#include "program_table.hpp"

namespace barycert::cli_test {
namespace {

Words sorted(Words words) {
    std::sort(words.begin(), words.end());
    return words;
}

class Bash {
public:
    explicit Bash(const Words& of = {}) {
        Words call{"help"};
        call.insert(call.end(), of.begin(), of.end());
        call.insert(call.end(), {"--completion", "bash"});
        const Ended made = run(call);
        EXPECT_EQ(made.code, 0) << made.err;
        // Does what bash does on TAB, for words that are given as bash splits them.
        driver_ = scratch_.put("driver.bash", made.out +
                                                  "COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1))\n"
                                                  "spec=$(complete -p \"$1\")\n"
                                                  "[[ $spec =~ -F\\ ([^ ]+) ]] && ${BASH_REMATCH[1]}\n"
                                                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    }

    Words offers(Words words, const std::string& folder = "/") const {
        words.insert(words.begin(), {"--norc", driver_});
        const Ended r = run(words, {.folder = folder, .program = "/bin/bash"});
        EXPECT_EQ(r.err, "");
        Words lines = lines_of(r.out);
        lines.erase(std::remove(lines.begin(), lines.end(), ""), lines.end());
        return sorted(lines);
    }

private:
    Scratch scratch_;
    std::string driver_;
};

bool has_bash() {
    return std::filesystem::exists("/bin/bash");
}

TEST(Completion, BashOffersEveryCommandAndOption) {
    if (!has_bash()) GTEST_SKIP() << "bash is not installed";
    const Bash bash;
    for (const ListedCommand& command : listed_commands()) {
        Words line{"barycert"};
        line.insert(line.end(), command.words.begin(), command.words.end());
        line.emplace_back("--");
        EXPECT_EQ(bash.offers(line), sorted(command.options)) << ::testing::PrintToString(line);
    }
    EXPECT_EQ(bash.offers({"barycert", "re"}), (Words{"render", "replay", "resample"}));
    EXPECT_EQ(bash.offers({"barycert", "sample", "--thr"}), Words{"--threads"});
    EXPECT_EQ(bash.offers({"barycert", "help", "re"}), (Words{"render", "replay", "resample"}));
    EXPECT_EQ(bash.offers({"barycert", "help", "render", "is"}), Words{"iso"});
    EXPECT_EQ(bash.offers({"barycert", "help", "render", "aud"}, "/"), Words{});
    const Words pictures = bash.offers({"barycert", "render", ""}, "/");
    EXPECT_TRUE(std::binary_search(pictures.begin(), pictures.end(), "iso"));
}

TEST(Completion, BashOffersTheValuesOfOptions) {
    if (!has_bash()) GTEST_SKIP() << "bash is not installed";
    const Bash bash;
    EXPECT_EQ(bash.offers({"barycert", "sample", "--rounding", ""}), (Words{"correct", "plain"}));
    EXPECT_EQ(bash.offers({"barycert", "sample", "--rounding", "="}), (Words{"correct", "plain"}));
    EXPECT_EQ(bash.offers({"barycert", "sample", "--rounding", "=", "pl"}), Words{"plain"});
    EXPECT_EQ(bash.offers({"barycert", "sample", "--outside", ""}),
              (Words{"error", "extrapolate", "fill=", "nan", "nearest"}));
    EXPECT_EQ(bash.offers({"barycert", "resample", "--vtk-data", "lz"}), (Words{"lz4", "lzma"}));
    EXPECT_EQ(bash.offers({"barycert", "replay", "--simplex", "tri"}), (Words{"triangle", "triangle3d"}));
    EXPECT_EQ(bash.offers({"barycert", "audit", "--fail-on", "false_z"}), Words{"false_zero"});
    EXPECT_EQ(bash.offers({"barycert", "help", "--completion", ""}), (Words{"bash", "fish", "zsh"}));
    EXPECT_EQ(bash.offers({"barycert", "audit", "--count", ""}), Words{});
    for (const std::string what : {"kernels", "families"}) {
        Words names;
        const auto list = parse(run({what, "--json", "-"}).out);
        for (const auto& entry : list[what]) names.push_back(entry["name"]);
        EXPECT_EQ(bash.offers({"barycert", "audit", what == "kernels" ? "--kernel" : "--family", ""}), sorted(names));
        EXPECT_EQ(bash.offers({"barycert", what, ""}), sorted(names));
    }
}

TEST(Completion, BashOffersFilesWhereFilesAreTaken) {
    if (!has_bash()) GTEST_SKIP() << "bash is not installed";
    const Bash bash;
    const Scratch scratch;
    scratch.put("part one.node", "");
    scratch.put("part.vtu", "");
    const Words both{"part one.node", "part.vtu"};
    EXPECT_EQ(bash.offers({"barycert", "check", "pa"}, scratch.folder()), both);
    EXPECT_EQ(bash.offers({"barycert", "sample", "x", "--output", "pa"}, scratch.folder()), both);
    EXPECT_EQ(bash.offers({"barycert", "sample", "x", "--output", "=", "pa"}, scratch.folder()), both);
    EXPECT_EQ(bash.offers({"barycert", "sample", "--field", "T", "=", "pa"}, scratch.folder()), both);
    EXPECT_EQ(bash.offers({"barycert", "render", "pa"}, scratch.folder()), both);
    const Bash mesher({"mesh"});
    EXPECT_EQ(mesher.offers({"barycert-tetgen", "pa"}, scratch.folder()), both);
    EXPECT_EQ(mesher.offers({"barycert-tetgen", "--order", ""}), (Words{"1", "2"}));
#ifdef BARYCERT_TETGEN_PROGRAM
    const std::string help = run({"--help"}, {.program = BARYCERT_TETGEN_PROGRAM}).out;
    for (const std::string& option : mesher.offers({"barycert-tetgen", "--"}))
        EXPECT_TRUE(contains(help, "  " + option) || contains(help, "," + option)) << option;
#endif
}

TEST(Completion, ZshTakesTheScript) {
    if (!is_there("zsh")) GTEST_SKIP() << "zsh is not installed";
    const Scratch scratch;
    for (const Words& of : std::vector<Words>{{}, {"mesh"}}) {
        Words call{"help"};
        call.insert(call.end(), of.begin(), of.end());
        call.insert(call.end(), {"--completion", "zsh"});
        const std::string script = scratch.put("_barycert", run(call).out);
        const Ended parsed = run_shell("zsh -f -n " + script);
        EXPECT_EQ(parsed.code, 0);
        EXPECT_EQ(parsed.out + parsed.err, "");
        // Sourced after compinit it registers itself.
        const Ended sourced = run_shell("zsh -f -c 'autoload -Uz compinit && compinit -u -D && source " + script +
                                        " && print -r -- $_comps[barycert" + (of.empty() ? "" : "-tetgen") + "]'");
        EXPECT_EQ(sourced.out, of.empty() ? "_barycert\n" : "_barycert_tetgen\n") << sourced.err;
        // Loaded by zsh as a function of the file's name it completes at once.
        const std::string file = of.empty() ? "_barycert" : "_barycert-tetgen";
        scratch.put(file, run(call).out);
        const Ended loaded = run_shell("zsh -f -c 'fpath=(" + scratch.folder() + " $fpath); autoload -Uz " + file +
                                       "; _arguments() { print -r -- asked }; " + file + "'");
        EXPECT_EQ(loaded.out, "asked\n") << loaded.err;
        const std::string text = read_file(script);
        if (!of.empty()) continue;
        EXPECT_TRUE(contains(text, "offset.2\\^17"));  // the words are evaluated
        for (const ListedCommand& command : listed_commands()) {
            std::string function = "\n_barycert";
            for (const std::string& word : command.words) function += "_" + word;
            const std::size_t begin = text.find(function + "() {");
            ASSERT_NE(begin, std::string::npos) << function;
            const std::string body = text.substr(begin, text.find("\n}\n", begin) - begin);
            for (const std::string& option : command.options)
                EXPECT_TRUE(contains(body, option + "[") || contains(body, option + "=[")) << function << option;
        }
    }
}

TEST(Completion, FishOffersWhatTheScriptSays) {
    if (!is_there("fish")) GTEST_SKIP() << "fish is not installed";
    const Scratch scratch;
    const std::string script = scratch.put("barycert.fish", run({"help", "--completion", "fish"}).out);
    const auto offers = [&](const std::string& line) {
        const Ended r = run_shell("cd / && HOME=" + scratch.folder() + " fish --no-config -c 'source " + script +
                                  "; complete -C \"" + line + "\"'");
        EXPECT_EQ(r.err, "");
        Words words;
        for (const std::string& offer : lines_of(r.out)) {
            if (!offer.empty()) words.push_back(offer.substr(0, offer.find('\t')));
        }
        return sorted(words);
    };
    for (const ListedCommand& command : listed_commands()) {
        std::string line = "barycert ";
        for (const std::string& word : command.words) line += word + " ";
        EXPECT_EQ(offers(line + "--"), sorted(command.options)) << line;
    }
    EXPECT_EQ(offers("barycert re"), (Words{"render", "replay", "resample"}));
    EXPECT_EQ(offers("barycert help re"), (Words{"render", "replay", "resample"}));
    EXPECT_EQ(offers("barycert sample --rounding "), (Words{"correct", "plain"}));
    EXPECT_EQ(offers("barycert audit --kernel triangle.inv"), Words{"triangle.inverse"});
    EXPECT_EQ(offers("barycert render iso --colour"), Words{"--colours"});
}

}  // namespace
}  // namespace barycert::cli_test
