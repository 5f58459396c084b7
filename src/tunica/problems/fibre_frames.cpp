#include "tunica/problems/fibre_frames.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <limits>
#include <sstream>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/tet4.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/problems/extension_problem.hpp"

namespace tunica::problems {

// The frame of an element from an outward vector o and a vector l along the wall:
//
//   e_z = l / |l|,   e_r ∥ o − (o·e_z) e_z,   e_θ = e_z × e_r
//
// tube:     l the axis, o the centroid's distance vector from it.
// laplace:  l = ∇φ_l, φ_l = 0 on the start and 1 on the end; o = ∇φ_o, φ_o = 0 on the inner and 1
//           on the outer surface; both harmonic. The gradients are averaged to the nodes by
//           volume and from there to the element: the gradient of a single linear tetrahedron
//           follows its faces, and it is zero where all four vertices lie on one surface.
// mesh:     o and l from the file.
//
// Source: rule-based fibres of [LDRB], of which a wall needs these two functions only.

namespace {

constexpr const char* where = "Wall / Fibre Frame";

/// The two directions an element's frame is made of, not normalised.
struct Directions {
  std::vector<Vec3> outward, along;
};

using Names = Teuchos::Array<std::string>;
constexpr const char* surface_keys[] = {"inner surfaces", "outer surfaces", "start surfaces",
                                        "end surfaces"};

Vec3 vector_of(const Teuchos::ParameterList& list, const char* key) {
  const auto& v = list.get<Teuchos::Array<double>>(key);
  return {v[0], v[1], v[2]};
}

Vec3 centroid(const fields::FieldMesh& mesh, std::size_t e) {
  Vec3 centre{};
  for (const int a : mesh.tets[e]) centre += 0.25 * mesh.x[a];
  return centre;
}

Directions tube_directions(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh) {
  const Vec3 point = vector_of(list, "axis point"), axis = vector_of(list, "axis direction");
  Directions directions;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    // o = x_e − x_axis; its part along the axis is taken out in frames_of()
    directions.outward.push_back(centroid(mesh, e) - point);
    directions.along.push_back(axis);
  }
  return directions;
}

/// Elementwise means of the gradient of nodal values, by way of the nodes.
std::vector<Vec3> smooth_gradient(const fields::FieldMesh& mesh, const std::vector<double>& phi) {
  std::vector<Vec3> sum(mesh.n_nodes());
  std::vector<double> volume(mesh.n_nodes(), 0.0);
  for (const auto& nodes : mesh.tets) {
    const kernels::Tet4 T = kernels::make_tet4(assembly::gather(mesh.x, nodes));
    Vec3 gradient{};
    for (int a = 0; a < 4; ++a) gradient += phi[nodes[a]] * T.grad_N[a];
    for (const int a : nodes) {
      sum[a] += T.volume * gradient;
      volume[a] += T.volume;
    }
  }
  // g_a = Σ_e V_e ∇φ_e / Σ_e V_e at the nodes, then the mean of an element's four
  for (int a = 0; a < mesh.n_owned; ++a) sum[a] = 1.0 / volume[a] * sum[a];
  const std::vector<Vec3> nodal = fields::ghosted_vectors(mesh, sum);
  std::vector<Vec3> mean;
  for (const auto& nodes : mesh.tets)
    mean.push_back(0.25 * (nodal[nodes[0]] + nodal[nodes[1]] + nodal[nodes[2]] + nodal[nodes[3]]));
  return mean;
}

/// Marks the nodes on the named surfaces.
std::vector<char> on_surfaces(const fields::FieldMesh& mesh, const Names& names) {
  std::vector<char> is_on(mesh.n_nodes(), 0);
  for (const std::string& name : names) {
    const int surface = mesh.surface_index(name);
    TUNICA_CHECK(surface >= 0, std::string(where) + ": the mesh has no surface \"" + name + "\". " +
                                   params::did_you_mean(name, mesh.surfaces));
    for (int a = 0; a < mesh.n_nodes(); ++a)
      if (mesh.is_on(a, surface)) is_on[a] = 1;
  }
  return is_on;
}

/// Gradient of the harmonic function that is 0 on one set of surfaces and 1 on another.
std::vector<Vec3> gradient_between(const Teuchos::ParameterList& list,
                                   const fields::FieldMesh& mesh, const char* from,
                                   const char* to) {
  std::vector<char> is_given = on_surfaces(mesh, list.get<Names>(from));
  const std::vector<char> is_one = on_surfaces(mesh, list.get<Names>(to));
  for (std::size_t a = 0; a < is_given.size(); ++a) is_given[a] = is_given[a] || is_one[a];
  // −Δφ = 0, φ = 0 on the one and 1 on the other, no flux elsewhere
  Vector phi(mesh.node_map);
  {
    const auto view = phi.getLocalViewHost(overwrite_all);
    for (int a = 0; a < mesh.n_owned; ++a) view(a, 0) = is_one[a];
  }
  const discretisation::HarmonicExtension extension(mesh, is_given);
  ExtensionProblem harmonic(list.sublist("Linear Solver"), extension, 1);
  const Outcome outcome = harmonic.extend(phi);
  TUNICA_CHECK(outcome.is_success(), std::string(where) + ": " + outcome.reason() + " between \"" +
                                         from + "\" and \"" + to + "\".");
  return smooth_gradient(mesh, fields::ghosted_scalars(mesh, phi));
}

double largest_norm(const fields::FieldMesh& mesh, const std::vector<Vec3>& vectors) {
  double largest = 0.0;
  for (const Vec3& v : vectors) largest = std::max(largest, norm(v));
  return global_max(*mesh.comm, largest);
}

/// The wrong element of the smallest number speaks, whoever holds it.
void agree(const fields::FieldMesh& mesh, int element, const std::string& what) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double mine = element < 0 ? none : static_cast<double>(mesh.tet_number[element]);
  const double first = global_min(*mesh.comm, mine);
  if (first == none) return;
  std::string message;
  if (mine == first) {
    const Vec3 x = centroid(mesh, element);
    std::ostringstream text;
    text << where << ": element " << mesh.tet_number[element] << " at (" << x[0] << ", " << x[1]
         << ", " << x[2] << ") has no " << what;
    message = text.str();
  }
  throw_if_any<Error>(*mesh.comm, message);
}

std::vector<materials::Frame> frames_of(const fields::FieldMesh& mesh, const Directions& d,
                                        const std::string& advice) {
  constexpr double tiny = 1e-6;  // relative: below, directions are noise
  // Lengths count against the largest one: those of gradients depend on the size of the vessel.
  const double scale_along = largest_norm(mesh, d.along);
  const double scale_outward = largest_norm(mesh, d.outward);
  std::vector<materials::Frame> frames;
  int no_axial = -1, no_radial = -1;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const double length = norm(d.along[e]);
    if (no_axial < 0 && !(length > tiny * scale_along)) no_axial = static_cast<int>(e);
    materials::Frame frame;
    // e_z = l/|l|,   e_r ∥ o − (o·e_z) e_z,   e_θ = e_z × e_r
    frame.axial = 1.0 / length * d.along[e];
    const Vec3 across = d.outward[e] - dot(d.outward[e], frame.axial) * frame.axial;
    if (no_radial < 0 && !(norm(across) > tiny * scale_outward)) no_radial = static_cast<int>(e);
    frame.radial = unit(across);
    frame.circumferential = cross(frame.axial, frame.radial);
    frames.push_back(frame);
  }
  agree(mesh, no_axial, "axial direction: " + advice);
  agree(mesh, no_radial, "radial direction: " + advice);
  return frames;
}

std::vector<Vec3> vectors_of(const fields::FieldMesh& mesh, const std::string& name) {
  std::vector<std::string> names;
  for (const mesh::TetVectors& vectors : mesh.tet_vectors) {
    if (vectors.name == name) return vectors.values;
    names.push_back(vectors.name);
  }
  throw Error(std::string(where) + ": the mesh has no vectors \"" + name + "\" on its elements. " +
              (names.empty() ? "It has none at all." : params::did_you_mean(name, names)));
}

params::Table mesh_table() {
  params::Table table("from vectors on the elements of the mesh file");
  table
      .text(
          "axial vectors", "axial",
          "name of the vectors along the vessel: a $ElementData of three components in a Gmsh file")
      .text("radial vectors", "radial",
            "name of the vectors out of the lumen, of any length; only their part perpendicular to "
            "the axial ones is used");
  return table;
}

params::Table tube_table() {
  params::Table table("from a straight axis");
  table.numbers("axis point", std::vector<double>{0, 0, 0}, params::any(), 3, "mm", "on the axis")
      .numbers("axis direction", std::vector<double>{0, 0, 1}, params::any(), 3, "1",
               "direction of the axis, of any length")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(norm(vector_of(list, "axis direction")) > 0.0,
                     path + ": \"axis direction\" is zero, expected a vector along the axis.");
      });
  return table;
}

params::Table laplace_table() {
  params::Table table("from harmonic functions, for vessels of any shape");
  const std::vector<std::string> fallbacks[] = {
      {"interface"}, {"outer"}, {"struct_in"}, {"struct_out"}};
  const char* sentences[] = {"at the lumen", "opposite to the lumen", "at one end of the vessel",
                             "at the other end"};
  for (int k = 0; k < 4; ++k) table.names(surface_keys[k], fallbacks[k], sentences[k]);
  table.sublist("Linear Solver", linear::scalar_solver_table())
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        for (int k = 0; k < 4; ++k) {
          const auto& names = list.get<Names>(surface_keys[k]);
          TUNICA_CHECK(!names.empty(), path + ": \"" + surface_keys[k] +
                                           "\" is empty, expected surfaces of the wall.");
          const auto& others = list.get<Names>(surface_keys[k ^ 1]);
          for (const std::string& name : names)
            TUNICA_CHECK(std::count(others.begin(), others.end(), name) == 0,
                         path + ": the surface \"" + name + "\" is in both \"" + surface_keys[k] +
                             "\" and \"" + surface_keys[k ^ 1] + "\".");
        }
      });
  return table;
}

}  // namespace

params::Table fibre_frame_table() {
  params::Table table(
      "Radial, circumferential and axial direction of each element of the wall, which laws with "
      "fibres need. Others ignore it.");
  table.variant("kind", "none",
                {{"none", params::Table("no directions")},
                 {"tube", tube_table()},
                 {"laplace", laplace_table()},
                 {"mesh", mesh_table()}},
                "source of the directions");
  return table;
}

std::vector<std::string> frame_surfaces(const Teuchos::ParameterList& list) {
  std::vector<std::string> names;
  if (list.get<std::string>("kind") != "laplace") return names;
  for (const char* key : surface_keys)
    for (const std::string& name : list.get<Names>(key)) names.push_back(name);
  return names;
}

std::vector<materials::Frame> fibre_frames(const Teuchos::ParameterList& list,
                                           const fields::FieldMesh& mesh) {
  const auto& kind = list.get<std::string>("kind");
  if (kind == "tube")
    return frames_of(mesh, tube_directions(list, mesh),
                     "it lies on the axis. Check \"axis point\" and \"axis direction\".");
  if (kind == "mesh")
    return frames_of(mesh,
                     {vectors_of(mesh, list.get<std::string>("radial vectors")),
                      vectors_of(mesh, list.get<std::string>("axial vectors"))},
                     "the mesh file gives none, or the same as the other one.");
  const Directions directions{gradient_between(list, mesh, "inner surfaces", "outer surfaces"),
                              gradient_between(list, mesh, "start surfaces", "end surfaces")};
  return frames_of(mesh, directions,
                   "the harmonic functions do not change there. Check the four lists of surfaces.");
}

}  // namespace tunica::problems
