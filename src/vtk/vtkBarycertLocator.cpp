#include "vtkBarycertLocator.h"

#include <atomic>
#include <mutex>
#include <set>
#include <tuple>

#include <vtkBox.h>
#include <vtkCellType.h>
#include <vtkDataSet.h>
#include <vtkGarbageCollector.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>

#include "barycert/environment.hpp"
#include "vtk/exact_index.hpp"

using namespace barycert;

struct vtkBarycertLocator::Internals {
    using Index = in_vtk::ExactIndex;

    explicit Internals(vtkBarycertLocator& of) : self(of) {}

    // The index; made at the first query if nobody has called BuildLocator. Null if there is no data set.
    const Index* ready() {
        if (const Index* const made = built) return made;
        const std::lock_guard lock(building);
        if (built == nullptr) self.BuildLocator();
        return built;
    }

    // The index if it answers.
    const Index* exact() {
        const Index* const made = ready();
        return made != nullptr && made->exact() ? made : nullptr;
    }

    // VTK's locator, for lines, planes and boxes. Null if there is no data set, or nothing in it.
    vtkStaticCellLocator* other() {
        if (ready() == nullptr || self.DataSet->GetNumberOfCells() == 0) return nullptr;
        if (vtkStaticCellLocator* const made = other_built) return made;
        const std::lock_guard lock(building);
        if (!of_vtk) {
            const auto made = vtkSmartPointer<vtkStaticCellLocator>::New();
            made->SetDataSet(self.DataSet);
            made->SetTolerance(self.Tolerance);
            made->SetNumberOfCellsPerNode(self.NumberOfCellsPerNode);
            made->BuildLocator();
            of_vtk = made;
        }
        other_built = of_vtk.Get();
        return of_vtk;
    }

    // The cell that the caller gave, or one made, with what the data set has of that id.
    vtkSmartPointer<vtkGenericCell> fetched(vtkIdType id, vtkSmartPointer<vtkGenericCell> cell) {
        if (cell == nullptr) cell = vtkSmartPointer<vtkGenericCell>::New();
        self.DataSet->GetCell(id, cell);
        return cell;
    }

    // The index, if it has a surface whose hits are to be exact: then sets them, in their order.
    const Index* hits(const double* p1, const double* p2, std::vector<SurfaceHit>& all) {
        const Index* const made = exact();
        if (made == nullptr || !made->on_surface || self.Tolerant) return nullptr;
        if (Result<std::vector<SurfaceHit>> found = made->on_surface->hits(p1, p2))
            all = std::move(*found);
        else
            vtkErrorWithObjectMacro(&self, "cannot intersect with this line: " << found.error().message());
        std::set<vtkIdType> met;  // a polygon has several triangles
        std::erase_if(all, [&](const SurfaceHit& hit) { return !met.insert(made->id(hit.triangle)).second; });
        return made;
    }

    vtkBarycertLocator& self;
    std::mutex building;
    std::shared_ptr<const Index> index;
    std::atomic<const Index*> built = nullptr;  ///< index, for threads that meet while it is made
    vtkSmartPointer<vtkStaticCellLocator> of_vtk;
    std::atomic<vtkStaticCellLocator*> other_built = nullptr;
};

vtkStandardNewMacro(vtkBarycertLocator);

vtkBarycertLocator::vtkBarycertLocator() : internals_(std::make_unique<Internals>(*this)) {}
vtkBarycertLocator::~vtkBarycertLocator() = default;

vtkObjectBase* vtkBarycertLocator::NewInstanceInternal() const {
    vtkBarycertLocator* const made = New();
    made->Tolerant = Tolerant;
    made->Interpolation = Interpolation;
    made->CurvedCells = CurvedCells;
    return made;
}

// A data set may have this as its locator, and VTK's locator has the data set.
void vtkBarycertLocator::ReportReferences(vtkGarbageCollector* collector) {
    Superclass::ReportReferences(collector);
    vtkGarbageCollectorReport(collector, internals_->of_vtk, "Other");
}

void vtkBarycertLocator::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    const in_vtk::ExactIndex* const index = internals_->built;
    os << indent << "Tolerant: " << (Tolerant ? "On" : "Off") << "\n"
       << indent << "Interpolation: " << Interpolation << "\n"
       << indent << "CurvedCells: " << CurvedCells << "\n";
    const char* const exact = index == nullptr ? "(not built)" : index->exact() ? "yes" : index->reason.c_str();
    os << indent << "Exact: " << exact << "\n";
}

void vtkBarycertLocator::SetDataSet(vtkDataSet* data) {
    if (data != DataSet) FreeSearchStructure();
    Superclass::SetDataSet(data);
}

void vtkBarycertLocator::BuildLocator() {
    if (DataSet == nullptr) {
        vtkErrorMacro("there is no data set to build from");
        return;
    }
    std::shared_ptr<const in_vtk::ExactIndex> index =
        in_vtk::exact_index(*DataSet, in_vtk::shape_of(Interpolation, CurvedCells));
    if (index != internals_->index) {
        FreeSearchStructure();
        internals_->index = std::move(index);
        if (!internals_->index->exact())
            vtkErrorMacro("points cannot be located exactly in this data set: " << internals_->index->reason);
        for (const Note& note : internals_->index->notes) vtkWarningMacro("" << message(note));
    } else if (internals_->of_vtk) {
        internals_->of_vtk->BuildLocator();
    }
    internals_->built = internals_->index.get();
    BuildTime.Modified();
}

void vtkBarycertLocator::ForceBuildLocator() {
    FreeSearchStructure();
    if (DataSet != nullptr) in_vtk::forget_index(*DataSet);
    BuildLocator();
}

void vtkBarycertLocator::FreeSearchStructure() {
    internals_->built = nullptr;
    internals_->other_built = nullptr;
    internals_->index.reset();
    internals_->of_vtk = nullptr;
}

void vtkBarycertLocator::ShallowCopy(vtkAbstractCellLocator* other) {
    auto* const from = SafeDownCast(other);
    if (from == nullptr) {
        vtkErrorMacro("ShallowCopy takes a vtkBarycertLocator, not " << (other ? other->GetClassName() : "null"));
        return;
    }
    SetDataSet(from->DataSet);
    Tolerant = from->Tolerant;
    Interpolation = from->Interpolation;
    CurvedCells = from->CurvedCells;
    CacheCellBounds = from->CacheCellBounds;
    Tolerance = from->Tolerance;
    FreeSearchStructure();
    internals_->index = from->internals_->index;
    internals_->built = internals_->index.get();
    if (internals_->index) BuildTime.Modified();
}

bool vtkBarycertLocator::GetExact() {
    return internals_->exact() != nullptr;
}

std::string vtkBarycertLocator::GetReason() {
    const in_vtk::ExactIndex* const index = internals_->ready();
    return index == nullptr ? "there is no data set" : index->reason;
}

// The weights of x in a cell of any kind, and its place there. VTK finds that, in double and by the cell's own map, for
// its functions of a cell take it so; of simplices, and where VTK fails, it is the mean of the places of the nodes.
static void set_place(const in_vtk::ExactIndex& index, const pieces::Closest& found, const double* x, vtkCell& cell,
                      double* pcoords, int& sub_id, double* weights) {
    const auto type = static_cast<std::uint8_t>(cell.GetCellType());
    std::array<double, 3> closest{};
    double distance = 0;
    const bool by_vtk =
        type != VTK_TETRA && type != VTK_TRIANGLE && !mesh::is_curved_simplex(type) &&
        cell.EvaluatePosition(found.point.data(), closest.data(), sub_id, pcoords, distance, weights) >= 0;
    index.weights_of_nodes(found.cell, x, found.inside, *cell.PointIds, weights);
    if (by_vtk) return;
    sub_id = 0;
    std::fill_n(pcoords, 3, 0.0);
    const double* const places = cell.GetParametricCoords();
    for (vtkIdType i = 0; places != nullptr && i < 3 * cell.GetNumberOfPoints(); ++i)
        pcoords[i % 3] += weights[i / 3] * places[i];
}

vtkIdType vtkBarycertLocator::FindCell(double x[3]) {
    const ExactEnvironment environment;
    const in_vtk::ExactIndex* const index = internals_->exact();
    return index != nullptr ? index->id(index->owner(x)) : -1;
}

vtkIdType vtkBarycertLocator::FindCell(double x[3], double tol2, vtkGenericCell* cell, int& subId, double pcoords[3],
                                       double* weights) {
    const ExactEnvironment environment;
    subId = 0;
    const in_vtk::ExactIndex* const index = internals_->exact();
    if (index == nullptr) return -1;
    pieces::Closest found{.cell = index->owner(x), .inside = true, .point = {x[0], x[1], x[2]}};
    if (found.cell < 0 && Tolerant && tol2 > 0) {
        found = index->closest(x, std::sqrt(pieces::held(tol2)));
        found.inside = false;
    }
    if (found.cell < 0) return -1;
    const vtkIdType id = index->id(found.cell);
    const vtkSmartPointer<vtkGenericCell> its = internals_->fetched(id, cell);
    if (index->cells_are_cut || !index->straight()) {
        set_place(*index, found, x, *its, pcoords, subId, weights);
        return id;
    }
    std::array<double, 3> point{};
    if (found.inside && index->project(x, point.data())) found.weights = index->weights(found.cell, point.data(), its);
    std::copy_n(found.weights.begin(), index->mesh.corners(), weights);
    // As vtkTetra and vtkTriangle have them: all weights but the first.
    for (std::size_t i = 0; i < 3; ++i) pcoords[i] = i + 1 < index->mesh.corners() ? weights[i + 1] : 0;
    return id;
}

void vtkBarycertLocator::FindClosestPoint(const double x[3], double closestPoint[3], vtkGenericCell* cell,
                                          vtkIdType& cellId, int& subId, double& dist2) {
    int inside = 0;
    double point[3] = {x[0], x[1], x[2]};
    FindClosestPointWithinRadius(point, std::numeric_limits<double>::infinity(), closestPoint, cell, cellId, subId,
                                 dist2, inside);
}

vtkIdType vtkBarycertLocator::FindClosestPointWithinRadius(double x[3], double radius, double closestPoint[3],
                                                           vtkGenericCell* cell, vtkIdType& cellId, int& subId,
                                                           double& dist2, int& inside) {
    cellId = -1;
    const in_vtk::ExactIndex* const index = internals_->exact();
    if (index == nullptr) return 0;
    const ExactEnvironment environment;
    const pieces::Closest found = index->closest(x, radius);
    if (found.cell < 0) return 0;
    cellId = index->id(found.cell);
    subId = 0;
    dist2 = pieces::held(found.distance) * found.distance;
    inside = found.inside ? 1 : 0;
    std::copy_n(found.point.begin(), 3, closestPoint);
    if (cell != nullptr) DataSet->GetCell(cellId, cell);
    return 1;
}

static std::array<double, 3> point_at(const double* p1, const double* p2, double t) {
    return {std::lerp(p1[0], p2[0], t), std::lerp(p1[1], p2[1], t), std::lerp(p1[2], p2[2], t)};
}

int vtkBarycertLocator::IntersectWithLine(const double p1[3], const double p2[3], double tol, double& t, double x[3],
                                          double pcoords[3], int& subId, vtkIdType& cellId, vtkGenericCell* cell) {
    const ExactEnvironment environment;
    cellId = -1;
    std::vector<SurfaceHit> hits;
    if (const in_vtk::ExactIndex* const index = internals_->hits(p1, p2, hits)) {
        if (hits.empty()) return 0;
        t = hits.front().parameter;
        subId = 0;
        cellId = index->id(hits.front().triangle);
        std::copy_n(point_at(p1, p2, t).begin(), 3, x);
        const vtkSmartPointer<vtkGenericCell> its = internals_->fetched(cellId, cell);
        std::vector<double> weights(static_cast<std::size_t>(its->GetNumberOfPoints()));
        const pieces::Closest at{.cell = hits.front().triangle, .inside = true, .point = {x[0], x[1], x[2]}};
        set_place(*index, at, x, *its, pcoords, subId, weights.data());
        return 1;
    }
    vtkStaticCellLocator* const other = internals_->other();
    return other == nullptr ? 0 : other->IntersectWithLine(p1, p2, tol, t, x, pcoords, subId, cellId, cell);
}

int vtkBarycertLocator::IntersectWithLine(const double p1[3], const double p2[3], vtkPoints* points,
                                          vtkIdList* cellIds) {
    if (IntersectWithLine(p1, p2, Tolerance, points, cellIds) == 0) return 0;
    const in_vtk::ExactIndex* const index = internals_->exact();
    if (index != nullptr && index->on_surface) {
        const Result<SurfaceLocation> start = index->on_surface->locate(p1);
        return start && start->winding != 0 ? -1 : 1;
    }
    double start[3] = {p1[0], p1[1], p1[2]};
    return FindCell(start) >= 0 ? -1 : 1;
}

int vtkBarycertLocator::IntersectWithLine(const double p1[3], const double p2[3], double tol, vtkPoints* points,
                                          vtkIdList* cellIds) {
    vtkNew<vtkGenericCell> cell;
    return IntersectWithLine(p1, p2, tol, points, cellIds, cell);
}

int vtkBarycertLocator::IntersectWithLine(const double p1[3], const double p2[3], double tol, vtkPoints* points,
                                          vtkIdList* cellIds, vtkGenericCell* cell) {
    if (points != nullptr) points->Reset();
    if (cellIds != nullptr) cellIds->Reset();
    const ExactEnvironment environment;
    std::vector<std::tuple<double, vtkIdType, std::array<double, 3>>> hits;  // how far along the line, cell, point
    std::vector<SurfaceHit> exact;
    vtkNew<vtkIdList> candidates;
    if (const in_vtk::ExactIndex* const index = cell != nullptr ? internals_->hits(p1, p2, exact) : nullptr) {
        for (const SurfaceHit& hit : exact)
            hits.emplace_back(hit.parameter, index->id(hit.triangle), point_at(p1, p2, hit.parameter));
    } else {
        FindCellsAlongLine(p1, p2, tol, candidates);
    }
    const double along[3] = {p2[0] - p1[0], p2[1] - p1[1], p2[2] - p1[2]};
    for (vtkIdType i = 0; i < candidates->GetNumberOfIds(); ++i) {
        const vtkIdType id = candidates->GetId(i);
        std::array<double, 3> x{}, pcoords{};
        double t = 0;
        int sub_id = 0;
        bool met = false;
        if (cell != nullptr) {
            DataSet->GetCell(id, cell);
            met = cell->IntersectWithLine(p1, p2, tol, t, x.data(), pcoords.data(), sub_id) != 0;
        } else {
            double bounds[6];
            DataSet->GetCellBounds(id, bounds);
            met = vtkBox::IntersectBox(bounds, p1, along, x.data(), t, tol) != 0;
        }
        if (met) hits.emplace_back(t, id, x);
    }
    if (candidates->GetNumberOfIds() > 0) std::sort(hits.begin(), hits.end());
    for (const auto& [t, id, x] : hits) {
        if (points != nullptr) points->InsertNextPoint(x.data());
        if (cellIds != nullptr) cellIds->InsertNextId(id);
    }
    return hits.empty() ? 0 : 1;
}

// Whether the box of a cell meets another.
static bool meets(vtkDataSet& data, vtkIdType cell, const double* box) {
    double its[6];
    data.GetCellBounds(cell, its);
    for (int a = 0; a < 6; a += 2)
        if (!(its[a] <= box[a + 1] && box[a] <= its[a + 1])) return false;
    return true;
}

void vtkBarycertLocator::FindCellsWithinBounds(double* bbox, vtkIdList* cells) {
    const ExactEnvironment environment;
    cells->Reset();
    vtkNew<vtkIdList> candidates;  // all cells of the buckets that the box meets
    if (vtkStaticCellLocator* const other = internals_->other()) other->FindCellsWithinBounds(bbox, candidates);
    for (vtkIdType i = 0; i < candidates->GetNumberOfIds(); ++i)
        if (meets(*DataSet, candidates->GetId(i), bbox)) cells->InsertNextId(candidates->GetId(i));
}

void vtkBarycertLocator::FindCellsAlongLine(const double p1[3], const double p2[3], double tolerance,
                                            vtkIdList* cells) {
    cells->Reset();
    if (vtkStaticCellLocator* const other = internals_->other()) other->FindCellsAlongLine(p1, p2, tolerance, cells);
}

void vtkBarycertLocator::FindCellsAlongPlane(const double origin[3], const double normal[3], double tolerance,
                                             vtkIdList* cells) {
    cells->Reset();
    if (vtkStaticCellLocator* const other = internals_->other())
        other->FindCellsAlongPlane(origin, normal, tolerance, cells);
}

bool vtkBarycertLocator::InsideCellBounds(double x[3], vtkIdType cellId) {
    const ExactEnvironment environment;
    if (DataSet == nullptr || cellId < 0 || cellId >= DataSet->GetNumberOfCells()) return false;
    const double point[6] = {x[0], x[0], x[1], x[1], x[2], x[2]};
    return meets(*DataSet, cellId, point);
}

void vtkBarycertLocator::GenerateRepresentation(int level, vtkPolyData* surface) {
    if (vtkStaticCellLocator* const other = internals_->other()) other->GenerateRepresentation(level, surface);
}
