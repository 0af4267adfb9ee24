// OpenSubdiv's Far: `opensubdiv SCHEME IN.off …`, SCHEME loop or catmull-clark.
//
// `--topology last-level` (its default) keeps of the last level only what its points and the corners of its faces need;
// `full` makes all its incidences. Building the base level from the file is loading, refining its topology and its points
// (f64) is the step. `--boundary edge-only|edge-and-corner`, `--creasing uniform|chaikin`; `--sharpness FILE` holds lines
// `edge a b sharpness` and `corner v sharpness`, vertices counted from 0.
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>
#include <sstream>

#include "mesh.hpp"

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// What the primvar refiner wants of a point.
struct Primvar {
  double x, y, z;
  void Clear() { x = y = z = 0; }
  void AddWithWeight(const Primvar& p, double weight) { x += weight * p.x, y += weight * p.y, z += weight * p.z; }
};

static bool one_of(const Arguments& arguments, const char* name, const char* first, const char* second) {
  std::string value = arguments.option(name, first);
  if (value != first && value != second) fail(std::string(name) + " is " + first + " or " + second);
  return value == second;
}

struct Sharpness {
  std::vector<int> edges, corners;
  std::vector<float> edge_weights, corner_weights;

  explicit Sharpness(const std::string& path) {
    if (path.empty()) return;
    std::istringstream in(read(path));
    std::string kind;
    float weight;
    for (int a, b; in >> kind;) {
      if (kind == "edge" && in >> a >> b >> weight) edges.push_back(a), edges.push_back(b), edge_weights.push_back(weight);
      else if (kind == "corner" && in >> a >> weight) corners.push_back(a), corner_weights.push_back(weight);
      else fail(path + " is damaged");
    }
  }
};

int main(int count, char** values) {
  Arguments arguments(count, values);
  Sdc::SchemeType scheme = Sdc::SCHEME_LOOP;
  if (arguments.scheme == "catmull-clark") scheme = Sdc::SCHEME_CATMARK;
  else if (arguments.scheme != "loop") fail("OpenSubdiv has no " + arguments.scheme);
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(one_of(arguments, "--boundary", "edge-only", "edge-and-corner")
                                          ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER
                                          : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  options.SetCreasingMethod(one_of(arguments, "--creasing", "uniform", "chaikin") ? Sdc::Options::CREASE_CHAIKIN
                                                                                  : Sdc::Options::CREASE_UNIFORM);

  Lists base = read_off(arguments.input);
  Sharpness sharpness(arguments.option("--sharpness", ""));
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(base.points.size());
  descriptor.numFaces = static_cast<int>(base.valences.size());
  descriptor.numVertsPerFace = base.valences.data();
  descriptor.vertIndicesPerFace = base.corners.data();
  descriptor.numCreases = static_cast<int>(sharpness.edge_weights.size());
  descriptor.creaseVertexIndexPairs = sharpness.edges.data();
  descriptor.creaseWeights = sharpness.edge_weights.data();
  descriptor.numCorners = static_cast<int>(sharpness.corners.size());
  descriptor.cornerVertexIndices = sharpness.corners.data();
  descriptor.cornerWeights = sharpness.corner_weights.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, Factory::Options(scheme, options)));
  if (!refiner) fail("OpenSubdiv does not accept " + arguments.input);
  base.corners = {}, base.valences = {};

  int steps = arguments.steps();
  std::unique_ptr<Primvar[]> points(new Primvar[base.points.size()]);
  for (size_t i = 0; i < base.points.size(); ++i) points[i] = {base.points[i][0], base.points[i][1], base.points[i][2]};
  base.points = {};
  double time = seconds([&] {
    Far::TopologyRefiner::UniformOptions uniform(steps);
    uniform.fullTopologyInLastLevel = one_of(arguments, "--topology", "last-level", "full");
    refiner->RefineUniform(uniform);
    Far::PrimvarRefinerReal<double> primvars(*refiner);
    for (int level = 1; level <= steps; ++level) {
      std::unique_ptr<Primvar[]> next(new Primvar[refiner->GetLevel(level).GetNumVertices()]);
      Primvar *from = points.get(), *to = next.get();
      primvars.Interpolate(level, from, to);
      points = std::move(next);
    }
  });

  Far::TopologyLevel const& last = refiner->GetLevel(steps);
  return report(arguments, time, last.GetNumFaces(), [&] {
    Lists lists;
    for (int v = 0; v < last.GetNumVertices(); ++v) lists.points.push_back({points[v].x, points[v].y, points[v].z});
    for (int f = 0; f < last.GetNumFaces(); ++f) {
      auto corners = last.GetFaceVertices(f);
      for (int i = 0; i < corners.size(); ++i) lists.corners.push_back(corners[i]);
      lists.valences.push_back(corners.size());
    }
    return lists;
  });
}
