// Which methods a command line asks for.
#include "tools/measure/methods.h"

#include <gtest/gtest.h>

#include "runtime/terrain/refine.h"

namespace overlook::measure {
namespace {

std::vector<std::string> labels_of(const std::vector<std::string>& methods, const std::vector<std::string>& sweeps) {
    Result<std::vector<MethodSpec>> specs = specs_from(methods, sweeps);
    EXPECT_TRUE(specs) << specs.error().message;
    std::vector<std::string> labels;
    if (!specs) return labels;
    for (const MethodSpec& spec : *specs) labels.push_back(label_of(spec));
    return labels;
}

std::string refusal_of(const std::vector<std::string>& methods, const std::vector<std::string>& sweeps) {
    Result<std::vector<MethodSpec>> specs = specs_from(methods, sweeps);
    if (specs) return "(taken)";
    EXPECT_EQ(specs.error().exit, Exit::bad_command);
    return specs.error().message;
}

using Strings = std::vector<std::string>;

TEST(Methods, AreNamedWithEverySetting) {
    EXPECT_EQ(labels_of({"terrain", "full", "terrain@samples=1@error-px=2.5@morph=1"}, {}),
              (Strings{"terrain@error-px=1@samples=4@morph=0.5", "full@samples=4", "terrain@error-px=2.5@samples=1@morph=1"}));
}

TEST(Methods, AreReadBackFromTheirLabels) {
    for (const char* text :
         {"terrain@error-px=0.5@samples=1@morph=0.25", "terrain:hard@error-px=2@samples=1", "full@samples=2",
          "lod-sprite:paper@error-px=1@low-error-px=8@key-error-px=1@depth-thickness=0.001@strips=1@samples=4"}) {
        Result<MethodSpec> spec = parse_method(text);
        ASSERT_TRUE(spec) << spec.error().message;
        EXPECT_EQ(label_of(*spec), text);
    }
}

TEST(Methods, NameWhatIsChosenByWord) {
    Result<MethodSpec> spec = parse_method("lod-sprite@keyframe=thread");
    ASSERT_TRUE(spec) << spec.error().message;
    EXPECT_EQ(setting(*spec, "keyframe"), 1);
    EXPECT_NE(label_of(*spec).find("@keyframe=thread"), std::string::npos);
    EXPECT_EQ(*parse_method(label_of(*spec)), *spec);
    EXPECT_EQ(label_of(*parse_method("lod-sprite")).find("keyframe"), std::string::npos);
    EXPECT_EQ(labels_of({"lod-sprite"}, {"keyframe=at-once,thread,sliced"}).size(), 3u);
    for (const char* wrong : {"1", "threads", ""})
        EXPECT_EQ(refusal_of({std::string("lod-sprite@keyframe=") + wrong}, {}),
                  std::string("--method lod-sprite@keyframe=") + wrong + ": keyframe takes at-once, thread or sliced");
}

TEST(Methods, HaveVariantsThatAreCurvesOfTheirOwn) {
    EXPECT_EQ(labels_of({"terrain:hard@error-px=2", "terrain"}, {}),
              (Strings{"terrain:hard@error-px=2@samples=4", "terrain@error-px=1@samples=4@morph=0.5"}));
    EXPECT_EQ(family_of(*parse_method("terrain:hard")), "terrain:hard");
}

TEST(Methods, WithinABudgetAreACurveOfTheirOwn) {
    EXPECT_EQ(labels_of({"terrain@triangles=20000", "terrain:hard@triangles=0"}, {}),
              (Strings{"terrain@error-px=1@samples=4@morph=0.5@triangles=20000", "terrain:hard@error-px=1@samples=4"}));
    EXPECT_EQ(family_of(*parse_method("terrain@triangles=20000")), "terrain@triangles");
    EXPECT_EQ(family_of(*parse_method("terrain@triangles=0")), "terrain");
    EXPECT_EQ(budget_of(*parse_method("terrain:hard@triangles=7")), 7);
    EXPECT_EQ(budget_of(floor_spec(4)), 0);
    EXPECT_EQ(labels_of({"terrain:hard@triangles=0", "terrain:hard@error-px=0.5"}, {"error-px=1", "triangles=10,20"}),
              (Strings{"terrain:hard@error-px=1@samples=4", "terrain:hard@error-px=0.5@samples=4@triangles=10",
                       "terrain:hard@error-px=0.5@samples=4@triangles=20"}));
}

TEST(Methods, MorphAsThePlayerDoesUnlessAskedOtherwise) {
    EXPECT_EQ(morph_of(*parse_method("terrain")), terrain::kDefaultMorph);
    EXPECT_EQ(morph_of(*parse_method("terrain@morph=0.75")), 0.75);
    EXPECT_EQ(morph_of(*parse_method("terrain:hard")), 0);
}

TEST(Methods, SweepsMultiplyThoseThatHaveTheSetting) {
    EXPECT_EQ(labels_of({"terrain", "full"}, {"error-px=0.5,2"}),
              (Strings{"terrain@error-px=0.5@samples=4@morph=0.5", "terrain@error-px=2@samples=4@morph=0.5", "full@samples=4"}));
    EXPECT_EQ(labels_of({"terrain"}, {"error-px=1,2", "samples=1,4"}),
              (Strings{"terrain@error-px=1@samples=1@morph=0.5", "terrain@error-px=1@samples=4@morph=0.5",
                       "terrain@error-px=2@samples=1@morph=0.5", "terrain@error-px=2@samples=4@morph=0.5"}));
}

TEST(Methods, SweepsLeaveAloneWhatWasGiven) {
    EXPECT_EQ(labels_of({"terrain@error-px=3", "terrain"}, {"error-px=1,2"}),
              (Strings{"terrain@error-px=3@samples=4@morph=0.5", "terrain@error-px=1@samples=4@morph=0.5",
                       "terrain@error-px=2@samples=4@morph=0.5"}));
}

TEST(Methods, AreMeasuredOnceHoweverOftenAskedFor) {
    EXPECT_EQ(labels_of({"terrain", "terrain@error-px=1"}, {}), (Strings{"terrain@error-px=1@samples=4@morph=0.5"}));
}

TEST(Methods, OfAWrongNameAreRefusedWithTheNearest) {
    EXPECT_EQ(refusal_of({"terain"}, {}),
              "--method terain: there is no such method; did you mean terrain? (known: terrain, lod-sprite, caveclod, discrete, wang-ldi, full)");
    EXPECT_EQ(refusal_of({"xyzzyxyzzy"}, {}), "--method xyzzyxyzzy: there is no such method (known: terrain, lod-sprite, caveclod, discrete, wang-ldi, full)");
    EXPECT_EQ(refusal_of({""}, {}).substr(0, 31), "--method : there is no such met");
    EXPECT_EQ(refusal_of({"terrain:soft"}, {}), "--method terrain:soft: terrain has no such variant");
    EXPECT_EQ(refusal_of({"terrain:"}, {}), "--method terrain:: terrain has no such variant");
    EXPECT_EQ(refusal_of({"terrain:hard@morph=1"}, {}), "--method terrain:hard@morph=1: terrain:hard has no setting morph");
    EXPECT_EQ(refusal_of({"terrain@eror-px=2"}, {}),
              "--method terrain@eror-px=2: terrain has no setting eror-px; did you mean error-px?");
    EXPECT_EQ(refusal_of({"full@error-px=2"}, {}), "--method full@error-px=2: full has no setting error-px");
}

TEST(Methods, OfAWrongValueAreRefused) {
    for (const char* value : {"", "x", "0", "-1", "nan", "inf", "1e9", "1 ", "1x"}) {
        std::string text = std::string("terrain@error-px=") + value;
        EXPECT_EQ(refusal_of({text}, {}), "--method " + text + ": error-px takes a number from 0.01 to 1000");
    }
    EXPECT_EQ(refusal_of({"terrain@morph=1.5"}, {}), "--method terrain@morph=1.5: morph takes a number from 0 to 1");
    EXPECT_EQ(refusal_of({"full@samples=1.5"}, {}), "--method full@samples=1.5: samples takes a whole number from 1 to 8");
    EXPECT_EQ(refusal_of({"full@samples"}, {}), "--method full@samples: samples takes a whole number from 1 to 8");
    EXPECT_EQ(refusal_of({"full@samples=1@samples=2"}, {}), "--method full@samples=1@samples=2: samples is given twice");
}

TEST(Methods, SweepsOfNothingAreRefused) {
    EXPECT_EQ(refusal_of({"terrain"}, {"error-px"}), "--sweep error-px: setting=value,value,... is wanted");
    EXPECT_EQ(refusal_of({"terrain"}, {"error-px="}), "--sweep error-px=: error-px takes a number from 0.01 to 1000");
    EXPECT_EQ(refusal_of({"terrain"}, {"speed=1,2"}), "--sweep speed=1,2: none of the methods has a setting speed to sweep");
    EXPECT_EQ(refusal_of({"full"}, {"error-px=1"}), "--sweep error-px=1: none of the methods has a setting error-px to sweep");
}

}  // namespace
}  // namespace overlook::measure
