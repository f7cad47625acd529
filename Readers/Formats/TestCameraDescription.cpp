#include "Formats/CameraDescription.h"

#include "Support/formats/TestFiles.h"

#include <filesystem>
#include <stdexcept>

namespace
{

const std::vector<std::string> Channels = { "C1", "C2", "C3" };

class CameraDescriptions : public msi::testing::TemporaryFolder
{
protected:
  CameraDescriptions()
  {
    write("camera.csv", "wavelength,C1,C2,C3\n400,0.1,0.2,0.3\n410,0.4,0.5,0.6\n");
  }
  std::string effectError(const std::string& text) const
  {
    return errorOf([&] { msi::parseEffectList("list.json", text, Channels); });
  }
  std::string cameraError(const std::string& text) const
  {
    return errorOf([&] { msi::readCameraDescription(write("camera.json", text)); });
  }
};

msi::CameraEffect onlyEffect(const std::string& entry)
{
  return msi::parseEffectList("list.json", "[" + entry + "]", Channels).at(0);
}

TEST_F(CameraDescriptions, ReadsCurvesAndAllThatIsNoCurve)
{
  const auto d = msi::readCameraDescription(write("camera.json",
    R"({"camera": "camera.csv", "dark": [0.01, 0.02, 0.03], "white_level": 4095,
        "noise": {"read": 0.001, "shot": 0.002, "quantisation_step": 0.25}, "lens": 1,
        "white_after_effects": true,
        "effects": [{"effect": "filter_shift", "parameters": {"shift": 2.9}}]})"));
  EXPECT_EQ(d.camera.channels(), Channels);
  EXPECT_EQ(d.camera.wavelengths(), msi::WavelengthGrid({ 400, 410 }));
  EXPECT_EQ(
    d.camera.responsivity(), (Eigen::MatrixXd(3, 2) << 0.1, 0.4, 0.2, 0.5, 0.3, 0.6).finished());
  EXPECT_EQ(d.camera.dark(), Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(d.whiteLevel, 4095);
  ASSERT_TRUE(d.noise);
  EXPECT_EQ(d.noise->read, 0.001);
  EXPECT_EQ(d.noise->shot, 0.002);
  EXPECT_EQ(d.noise->fixedPatternGain, 0.0);
  EXPECT_EQ(d.noise->quantisationStep, 0.25);
  EXPECT_TRUE(d.whiteAfterEffects);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].name, "filter_shift");
  EXPECT_EQ(d.notes, (std::vector<std::string>{ "camera.json: key 'lens' was left unread" }));
}

TEST_F(CameraDescriptions, MostMayBeLeftOut)
{
  const auto d = msi::readCameraDescription(write("camera.json", "{}"));
  EXPECT_EQ(d.camera.dark(), Eigen::Vector3d::Zero());
  EXPECT_EQ(d.whiteLevel, 1.0);
  EXPECT_FALSE(d.noise);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_EQ(msi::readCameraDescription(write("camera.json", R"({"dark": 0.5})")).camera.dark(),
    Eigen::Vector3d::Constant(0.5));
}

TEST_F(CameraDescriptions, CurvesAloneAreACamera)
{
  const auto d = msi::readCameraDescription(path("camera.csv"));
  EXPECT_EQ(d.camera.channels(), Channels);
  EXPECT_EQ(d.camera.dark(), Eigen::Vector3d::Zero());
}

TEST_F(CameraDescriptions, RoundTripIsExact)
{
  const double third = 1.0 / 3.0;
  const msi::CameraDescription written{ { msi::WavelengthGrid({ 400, 402.5, 405 }),
                                          Eigen::MatrixXd::Random(3, 3),
                                          Eigen::Vector3d::Random() },
    255.0, msi::CameraNoise{ third, 1e-300, 0.1, 0.2, 1.0 / 255.0 },
    { { "channel_gain", "per_channel", "", { 1.0, 1.0 + 1e-16 + third, 0.9 } },
      { "specular_component", "body", "black \"velvet\"", { 0.1 * third } },
      { "vignetting", "cos4", "", { third, -third, 1e-17 } } },
    true };
  msi::writeCameraDescription(path("out.json"), written);
  const auto read = msi::readCameraDescription(path("out.json"));
  EXPECT_EQ(read.camera.responsivity(), written.camera.responsivity());
  EXPECT_EQ(read.camera.dark(), written.camera.dark());
  EXPECT_EQ(read.camera.wavelengths(), written.camera.wavelengths());
  EXPECT_EQ(read.camera.channels(), written.camera.channels());
  EXPECT_EQ(read.whiteLevel, 255.0);
  ASSERT_TRUE(read.noise);
  EXPECT_EQ(read.noise->read, third);
  EXPECT_EQ(read.noise->shot, 1e-300);
  EXPECT_EQ(read.noise->fixedPatternOffset, 0.2);
  EXPECT_EQ(read.noise->quantisationStep, 1.0 / 255.0);
  EXPECT_TRUE(read.whiteAfterEffects);
  EXPECT_TRUE(read.notes.empty());
  ASSERT_EQ(read.effects.size(), written.effects.size());
  for (std::size_t i = 0; i < read.effects.size(); ++i)
  {
    EXPECT_EQ(read.effects[i].name, written.effects[i].name);
    EXPECT_EQ(read.effects[i].form, written.effects[i].form);
    EXPECT_EQ(read.effects[i].medium, written.effects[i].medium);
    EXPECT_EQ(read.effects[i].parameters, written.effects[i].parameters);
  }
}

TEST_F(CameraDescriptions, EveryEffectAndFormOfTheLibraryRoundTrips)
{
  std::vector<msi::CameraEffect> all;
  for (const auto& effect : msi::effectLibrary())
  {
    const bool medium = effect.need == msi::EffectNeed::Medium;
    for (const auto& form : effect.forms)
    {
      all.push_back(msi::neutralEffect(effect.name, Channels, form.name, medium ? "fabric" : ""));
    }
  }
  const auto back = msi::parseEffectList("all", msi::effectListText(all, Channels), Channels);
  ASSERT_EQ(back.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    EXPECT_EQ(back[i].name, all[i].name);
    EXPECT_EQ(back[i].form, all[i].form);
    EXPECT_EQ(back[i].parameters, all[i].parameters);
  }
}

TEST_F(CameraDescriptions, TheParametersChooseTheForm)
{
  EXPECT_EQ(onlyEffect(R"({"effect": "filter_shift"})").form, "common");
  EXPECT_EQ(onlyEffect(R"({"effect": "filter_shift", "parameters": {"slope": 1}})").form, "linear");
  EXPECT_EQ(onlyEffect(R"({"effect": "filter_shift", "parameters": {"slope": 1}})").parameters,
    (std::vector<double>{ 0.0, 1.0 }));
  const auto list = onlyEffect(R"({"effect": "filter_shift", "parameters": {"shift": [1, 2, 3]}})");
  EXPECT_EQ(list.form, "per_channel");
  EXPECT_EQ(list.parameters, (std::vector<double>{ 1.0, 2.0, 3.0 }));
}

TEST_F(CameraDescriptions, FormerNamesOfParametersAreRead)
{
  EXPECT_EQ(onlyEffect(
              R"({"effect": "illumination_gradient", "parameters": {"right": 0.1, "down": -0.05}})")
              .parameters,
    (std::vector<double>{ 0.1, -0.05 }));
  EXPECT_EQ(
    effectError(
      R"([{"effect": "illumination_gradient", "parameters": {"right": 0.1, "along_x": 0.1}}])"),
    "list.json:1:3: effect 1 (illumination_gradient): the form plane has no parameter 'right'; "
    "expected one of along_x, along_y; correct the name");
}

TEST_F(CameraDescriptions, AChannelIsSingledOut)
{
  const auto one =
    onlyEffect(R"({"effect": "dark_offset", "parameters": {"offset": 0.01}, "channel": "C2"})");
  EXPECT_EQ(one.form, "per_channel");
  EXPECT_EQ(one.parameters, (std::vector<double>{ 0.0, 0.01, 0.0 }));
  EXPECT_EQ(onlyEffect(R"({"effect": "channel_gain", "parameters": {"gain": 1.5}})").parameters,
    (std::vector<double>{ 1.5, 1.5, 1.5 }));
}

TEST_F(CameraDescriptions, EffectErrors)
{
  EXPECT_EQ(effectError("3"),
    "list.json: holds number; expected a list of effects, [{\"effect\": ..., \"parameters\": "
    "{...}}, ...]; see Formats.md");
  EXPECT_EQ(effectError("[1]"),
    "list.json: effect 1: holds number; expected an object with effect and parameters; correct the "
    "entry");
  EXPECT_EQ(effectError("[{\"effect\": \"filter_shift\"},\n {\"effect\": \"filter_shift\",\n"
                        "  \"parameters\": {\"shift\": 40}}]"),
    "list.json:2:3: effect 2 (filter_shift): parameter 'shift' is 40; expected a number from -25 "
    "to 25 (nm); correct the value");
  EXPECT_EQ(effectError(R"([{"effect": "exposure_gain", "parameters": {"gain": "much"}}])"),
    "list.json:1:3: effect 1 (exposure_gain): parameter 'gain' is \"much\"; expected a number from "
    "0.2 to 5; correct the value");
  EXPECT_EQ(effectError(R"([{"effect": "filter_shift", "parameters": {"size": 1}}])"),
    "list.json:1:3: effect 1 (filter_shift): the form common has no parameter 'size'; expected one "
    "of shift; correct the name");
  EXPECT_EQ(effectError(R"([{"effect": "filter_shift", "form": "round"}])"),
    "list.json:1:3: effect 1 (filter_shift): it has no form 'round'; expected one of common, "
    "of_neighbours, "
    "sampled, linear, own_levels, per_channel; correct the form");
  EXPECT_EQ(effectError(R"([{"effect": "channel_gain", "parameters": {"gain": [1, 2]}}])"),
    "list.json:1:3: effect 1 (channel_gain): parameter 'gain' has 2 values; expected 3, as the "
    "camera has channels; correct the list");
  EXPECT_EQ(effectError(R"([{"effect": "medium_gain", "parameters": {"gain": 0.9}}])"),
    "list.json:1:3: effect 1 (medium_gain): has no medium; expected the name of the medium that it "
    "acts on; add the key 'medium'");
  EXPECT_EQ(effectError(R"([{"effect": "exposure_gain", "medium": "paper"}])"),
    "list.json:1:3: effect 1 (exposure_gain): has the medium 'paper'; expected no medium: this "
    "effect acts on all of them; remove the key 'medium'");
  EXPECT_EQ(effectError(R"([{"effect": "channel_gain", "channel": "C9"}])"),
    "list.json:1:3: effect 1 (channel_gain): the camera has no channel 'C9'; expected one of C1, "
    "C2, C3; correct the name");
  EXPECT_EQ(
    effectError(R"([{"effect": "exposure_gain", "parameters": {"gain": 2}, "channel": "C1"}])"),
    "list.json:1:3: effect 1 (exposure_gain): has a channel, but the form common treats all "
    "channels alike; expected a form that is per channel, of common; remove the key 'channel'");
  EXPECT_EQ(effectError(R"([{"effect": "lag", "size": 1}])"),
    "list.json:1:3: effect 1: has the unknown key 'size'; expected effect, form, parameters, "
    "channel and medium; remove the key");
  EXPECT_EQ(effectError(R"([{"effect": 5}])"),
    "list.json:1:3: effect 1: 'effect' holds number; expected a text; correct the value");
  EXPECT_EQ(effectError("[{\"effect\": \"lag\",\n"),
    "list.json:2:1: the JSON text ends too early; expected a JSON object; the file seems to be cut "
    "off");
  const std::string unknown = effectError(R"([{"effect": "ghosts"}])");
  EXPECT_EQ(unknown.rfind("list.json:1:3: effect 1 (ghosts): there is no effect of this name; "
                          "expected one of specular_component, ",
              0),
    0u)
    << unknown;
}

TEST_F(CameraDescriptions, DescriptionErrors)
{
  EXPECT_EQ(cameraError("[1]"),
    "camera.json: holds array; expected an object with camera, dark, noise and effects; see "
    "Formats.md");
  EXPECT_EQ(cameraError("{\n\"dark\": [1, 2]}"),
    "camera.json:2:1: 'dark' has 2 values; expected one, or 3 as the curves have channels; correct "
    "the list");
  EXPECT_EQ(cameraError("{\"white_level\": 0}"),
    "camera.json:1:2: 'white_level' has a value that cannot be used; expected a number above 0; "
    "correct the value");
  EXPECT_EQ(cameraError("{\"noise\": {\"shot\": -1}}"),
    "camera.json:1:12: 'shot' has a value that cannot be used; expected a number from 0 up, or "
    "null; correct the value");
  EXPECT_NE(
    cameraError("{\"noise\": {\"read\": 12}}")
      .find("'read' has a value that cannot be used; expected a standard deviation relative "
            "to white, up to 0.5 (counts over the white level)"),
    std::string::npos);
  EXPECT_EQ(cameraError("{\"white_after_effects\": 1}"),
    "camera.json:1:2: 'white_after_effects' has a value that cannot be used; expected true or "
    "false; correct the value");
  EXPECT_NE(cameraError("{\"camera\": \"none.csv\"}").find("none.csv"), std::string::npos);
}

TEST_F(CameraDescriptions, JsonThatWouldBeMisreadIsRefused)
{
  EXPECT_EQ(cameraError("{\"dark\": 0.1,\n \"dark\": 0.2}"),
    "camera.json:2:2: the key 'dark' stands twice in one object; expected every key once; remove "
    "one of them");
  EXPECT_EQ(cameraError("{\"noise\": {\"read\": 1e-3, \"shot\": 0,\n \"read\": 2e-3}}"),
    "camera.json:2:2: the key 'read' stands twice in one object; expected every key once; remove "
    "one of them");
  EXPECT_EQ(cameraError("{\"white_level\":\n 1e999}"),
    "camera.json:2:2: the number 1e999 is too large; expected a number below 1.8e308; correct the "
    "number");
  // The same key in two objects is no fault.
  EXPECT_EQ(cameraError(R"({"effects": [{"effect": "lag"}, {"effect": "lag"}]})"), "");
}

TEST_F(CameraDescriptions, CurvesAreThoseBesideOrBelowTheDescription)
{
  write("secret.txt", "root:x:0:0\n");
  std::filesystem::create_directories(path("below"));
  write("below/camera.csv", read("camera.csv"));
  EXPECT_EQ(cameraError(R"({"camera": "below/camera.csv"})"), "");
  const std::string refused =
    "camera.json:1:2: 'camera' has a value that cannot be used; expected the name of a file "
    "beside this one, or in a folder below; correct the value";
  for (const std::string& name :
    { std::string("../secret.txt"), std::string("below/../../camera.csv"),
      std::string("/etc/passwd"), std::string(), std::string("camera.csv\\u0000.png") })
  {
    EXPECT_EQ(cameraError("{\"camera\": \"" + name + "\"}"), refused) << name;
  }
}

TEST_F(CameraDescriptions, NothingIsWrittenForEffectsThatDoNotFit)
{
  const msi::CameraDescription bad{ msi::readCameraDescription(path("camera.csv")).camera, 1.0,
    std::nullopt, { { "exposure_gain", "", "", { 1.0, 2.0 } } } };
  EXPECT_THROW(msi::writeCameraDescription(path("bad.json"), bad), std::invalid_argument);
  EXPECT_THROW(msi::writeCameraDescription(path("bad.txt"), bad), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path("bad.json")));
  EXPECT_FALSE(std::filesystem::exists(path("bad.csv")));
}

} // namespace
