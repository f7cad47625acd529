#include "SecondScene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace withheld::second
{

namespace
{
// A smooth random curve: cosines with random weights that fall with the frequency.
Spectrum wave(Random& random, double size, int terms)
{
  Spectrum sum(0.0, wavelengths().size());
  for (int n = 1; n <= terms; ++n)
  {
    const double phase = uniform(random, 0.0, 6.2832);
    sum += normal(random, size / n) *
      std::cos(3.14159265 * n * (wavelengths() - Lowest) / (Highest - Lowest) + phase);
  }
  return sum;
}

Spectrum logistic(const Spectrum& z)
{
  return 1.0 / (1.0 + std::exp(-z));
}

class Palette
{
public:
  explicit Palette(Random& random)
    : Printed(chance(random, 0.4))
    , Brightest(uniform(random, 0.75, 0.95))
    , Darkest(uniform(random, 0.02, 0.05))
    , Terms(integer(random, 5, 9))
    , Spread(uniform(random, 0.5, 1.1))
  {
    for (int ink = 0; ink < 4; ++ink)
    {
      Inks.push_back(logistic(3.0 * wave(random, 1.2, 5) + normal(random, 0.4)));
    }
  }
  Spectrum draw(Random& random) const
  {
    Spectrum r(0.0, wavelengths().size());
    if (Printed)
    {
      // Yule and Nielsen with Demichel's areas.
      constexpr double N = 1.8;
      Spectrum root(1.0, wavelengths().size());
      for (const Spectrum& ink : Inks)
      {
        const double area = chance(random, 0.35) ? 0.0 : uniform(random, 0.0, 1.0);
        root *= 1.0 - area + area * std::pow(ink, 1.0 / N);
      }
      r = std::pow(root, N);
    }
    else if (chance(random, 0.1))
    {
      r = logistic(normal(random, 1.4) + 0.0 * wavelengths());
    }
    else
    {
      r = logistic(normal(random, 1.1) - 0.3 + wave(random, 2.2 * Spread, Terms));
    }
    return Darkest + (Brightest - Darkest) * r;
  }

private:
  bool Printed;
  double Brightest, Darkest;
  int Terms;
  double Spread;
  std::vector<Spectrum> Inks;
};
}

Scene drawScene(Random& random, int count, int fewestMedia)
{
  Scene scene;
  scene.media = integer(random, fewestMedia, 3);
  std::vector<Palette> palettes;
  for (int m = 0; m < scene.media; ++m)
  {
    palettes.emplace_back(random);
  }
  const int scenes = chance(random, 0.35) ? 2 : 1;
  const int inScene = (count + scenes - 1) / scenes;
  const int columns = std::max(3, static_cast<int>(std::sqrt(inScene * uniform(random, 0.7, 2.2))));
  // Media lie in blocks, one after the other, or mixed.
  const bool blocks = chance(random, 0.5);
  for (int i = 0; i < count; ++i)
  {
    Swatch swatch;
    swatch.scene = i / inScene;
    swatch.medium =
      blocks ? i % inScene * scene.media / inScene : integer(random, 0, scene.media - 1);
    swatch.reflectance = palettes[static_cast<std::size_t>(swatch.medium)].draw(random);
    const int place = i % inScene;
    swatch.x = scene.pitch * (place % columns + uniform(random, -0.1, 0.1));
    swatch.y = scene.pitch * (place / columns + uniform(random, -0.1, 0.1));
    scene.swatches.push_back(std::move(swatch));
  }
  std::vector<int> order(scene.swatches.size());
  std::iota(order.begin(), order.end(), 1);
  if (chance(random, 0.7))
  {
    std::shuffle(order.begin(), order.end(), random);
  }
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    Swatch& swatch = scene.swatches[i];
    swatch.order = order[i];
    left = std::min(left, swatch.x);
    right = std::max(right, swatch.x);
    top = std::min(top, swatch.y);
    bottom = std::max(bottom, swatch.y);
  }
  scene.middleX = 0.5 * (left + right);
  scene.middleY = 0.5 * (top + bottom);
  scene.half = 0.5 * std::max(right - left, bottom - top);
  return scene;
}

World makeWorld(const Camera& camera)
{
  World world;
  world.camera = camera;
  world.gain.assign(camera.passbands.size(), 1.0);
  world.dark.assign(camera.passbands.size(), 0.0);
  return world;
}

std::vector<double> whiteOf(const World& world)
{
  std::vector<double> white;
  for (const Spectrum& row : responsivities(world.camera))
  {
    white.push_back(row.sum());
  }
  return white;
}

namespace
{
void spread(const World& world, const Scene& scene, Responses& u)
{
  const std::size_t channels = world.gain.size();
  std::map<int, std::vector<double>> mean;
  std::map<int, double> members;
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    std::vector<double>& sum = mean[scene.swatches[i].scene];
    sum.resize(channels, 0.0);
    members[scene.swatches[i].scene] += 1.0;
    for (std::size_t k = 0; k < channels; ++k)
    {
      sum[k] += u[i][k];
    }
  }
  const Responses sharp = u;
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    const Swatch& self = scene.swatches[i];
    std::vector<double> around(channels, 0.0);
    double total = 0.0;
    for (std::size_t j = 0; j < u.size() && world.halo != 0.0; ++j)
    {
      const Swatch& other = scene.swatches[j];
      const double distance = std::hypot(self.x - other.x, self.y - other.y) / scene.pitch;
      if (i != j && self.scene == other.scene && distance < 4.0)
      {
        const double weight = std::pow(distance, -world.haloPower);
        total += weight;
        for (std::size_t k = 0; k < channels; ++k)
        {
          around[k] += weight * sharp[j][k];
        }
      }
    }
    for (std::size_t k = 0; k < channels; ++k)
    {
      u[i][k] += world.glare * mean[self.scene][k] / members[self.scene];
      u[i][k] += total > 0.0 ? world.halo * (around[k] / total - sharp[i][k]) : 0.0;
    }
  }
}
}

Responses respond(const World& world, const Scene& scene, const std::vector<double>& white)
{
  const std::vector<Spectrum> rows = responsivities(world.camera);
  const std::size_t channels = rows.size();
  Responses u;
  for (const Swatch& swatch : scene.swatches)
  {
    Spectrum r = swatch.reflectance;
    if (world.surface)
    {
      world.surface(r, swatch.medium);
    }
    const double place =
      world.field ? world.field(scene.fieldX(swatch), scene.fieldY(swatch)) : 1.0;
    u.emplace_back();
    for (std::size_t k = 0; k < channels; ++k)
    {
      u.back().push_back(place * (rows[k] * r).sum() / white[k]);
    }
  }
  spread(world, scene, u);
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    const std::vector<double> before = u[i];
    const double drift = world.drift ? world.drift(scene.time(scene.swatches[i])) : 1.0;
    for (std::size_t k = 0; k < channels; ++k)
    {
      double value = before[k];
      value += k > 0 ? world.right * (before[k - 1] - before[k]) : 0.0;
      value += k + 1 < channels ? world.left * (before[k + 1] - before[k]) : 0.0;
      value *= world.gain[k] * drift;
      value = world.curve ? world.curve(value) : value;
      value += world.dark[k];
      // A smooth knee below the ceiling.
      const double over = value - world.ceiling;
      u[i][k] = world.knee > 0.0 && over > -20.0 * world.knee
        ? world.ceiling - world.knee * std::log1p(std::exp(-over / world.knee))
        : std::min(value, world.ceiling);
    }
  }
  if (world.other)
  {
    world.other(u, scene);
  }
  return u;
}

} // namespace withheld::second
