"""Reads a mesh by meshio, and writes it as raw VTU; what it has read it tells in JSON.

It runs in a process of its own, which read_converted.cpp starts.

Arguments: the path, meshio's name of the format, bytes of memory and of output at most, seconds, and in JSON VTK's
numbers of cell types by meshio's names.

Descriptor 3 is for the mesh as a .vtu file, to the bit; stdout for what was read, in JSON; stderr for what meshio
prints. It ends with stdin, the program that asked. Modules come from no folder that the working directory decides.
"""
import sys

sys.path = [p for p in sys.path if p]
import json, os, re, resource, signal, threading
from xml.sax.saxutils import quoteattr

# Threads of linear algebra would each reserve memory; lines of messages are not to be broken.
os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", COLUMNS="1000", NO_COLOR="1")


def ends_with_parent():
    os.read(0, 1)
    os.killpg(0, signal.SIGKILL)


threading.Thread(target=ends_with_parent, daemon=True).start()
path, kind, memory, output, seconds, types = sys.argv[1:7]
for limit, most in (
    (resource.RLIMIT_AS, memory),
    (resource.RLIMIT_FSIZE, output),
    (resource.RLIMIT_CPU, seconds),
    (resource.RLIMIT_CORE, 0),
):
    hard = resource.getrlimit(limit)[1]
    most = int(most) if hard == resource.RLIM_INFINITY else min(int(most), hard)
    resource.setrlimit(limit, (most, most))
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
answer = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def tell(**what):
    json.dump(what, answer)
    answer.flush()
    os._exit(0)


try:
    import meshio, numpy
except ImportError as error:
    tell(missing=str(error))

TYPES = json.loads(types)
lost, files = [], []


def opened(event, arguments):
    """Files that are read beside the one that was named, XDMF's numbers for one: nothing may replace them."""
    if event == "open" and isinstance(arguments[0], (str, bytes)) and arguments[1] in (None, "r", "rb"):
        name = os.path.abspath(os.fsdecode(arguments[0]))
        if not name.startswith(("/proc/", "/dev/")):
            files.append(name)


def watch_hdf5():
    """HDF5 opens files by itself."""
    try:
        import h5py
    except ImportError:
        return

    class File(h5py.File):
        def __init__(self, name, *others, **named):
            files.append(os.path.abspath(os.fsdecode(name)))
            super().__init__(name, *others, **named)

    h5py.File = File


def refuse(what, expected, found, remedy):
    tell(refused=dict(what=what, expected=expected, found=found, remedy=remedy))


def take_all_nodes_of_abaqus():
    """meshio keeps the nodes of the last block *NODE alone, and lacks types of elements."""
    try:
        from meshio.abaqus import _abaqus

        one_block, known, types = _abaqus._read_nodes, {}, _abaqus.abaqus_to_meshio_type
    except (ImportError, AttributeError):  # another meshio
        return
    for names, cell in (
        ("CPS3 CPE3 CPE3H CAX3 CAX3H M3D3 SFM3D3 DC2D3", "triangle"),
        ("CPS6 CPS6M CPE6 CPE6H CPE6M CPE6MH CAX6 CAX6H CAX6M CAX6MH M3D6 DC2D6", "triangle6"),
        (
            "CPS4I CPE4 CPE4H CPE4I CPE4IH CPE4R CPE4RH CAX4 CAX4H CAX4I CAX4IH CAX4R CAX4RH M3D4 M3D4R "
            "R3D4 SFM3D4 SFM3D4R DC2D4",
            "quad",
        ),
        ("CPS8 CPS8R CPE8 CPE8H CPE8R CPE8RH CAX8 CAX8H CAX8R CAX8RH M3D8 M3D8R DC2D8", "quad8"),
        ("C3D4H DC3D4", "tetra"),
        ("DC3D10", "tetra10"),
        ("C3D5 C3D5H DC3D5", "pyramid"),
        ("C3D6H DC3D6", "wedge"),
        ("C3D15H DC3D15", "wedge15"),
        ("DC3D8", "hexahedron"),
        ("DC3D20", "hexahedron20"),
    ):
        types.update(dict.fromkeys(names.split(), cell))

    def all_blocks(f):
        points, ids, line = one_block(f)
        if f in known and len(points):
            before, numbers = known[f]
            twice = sorted(numbers.keys() & ids.keys())
            if twice:
                refuse(
                    "a number of two nodes",
                    "each number in one block *NODE: parts that number their nodes anew " "are not read",
                    "node %d in two of them" % twice[0],
                    "write one part, or the whole assembly flat",
                )
            if before.shape[1:] != points.shape[1:]:
                refuse(
                    "blocks *NODE that differ",
                    "as many coordinates in all",
                    "%d and %d" % (before.shape[1], points.shape[1]),
                    "write as many coordinates for each node",
                )
            ids = {**numbers, **{number: len(before) + i for number, i in ids.items()}}
            points = numpy.concatenate([before, points])
        elif f in known:
            points, ids = known[f]
        known[f] = points, ids
        return points, ids, line

    _abaqus._read_nodes = all_blocks


def check_su2(path):
    """meshio takes the nodes of the last zone for those of all."""
    with open(path, errors="replace") as file:
        lines = [line.split("=", 1) for line in file if "=" in line and not line.lstrip().startswith("%")]
    zones = sum(1 for line in lines if line[0].strip().upper() == "NDIME")
    announced = [line[1].split("%")[0].strip() for line in lines if line[0].strip().upper() == "NZONE"]
    if zones > 1 or any(count != "1" for count in announced):
        refuse(
            "a mesh of SU2 in several zones",
            "one zone, whose cells have its nodes",
            "%s zones" % (announced[0] if announced else zones),
            "write each zone to a file of its own, without NZONE and IZONE",
        )


def shape_of_kratos(block, name):
    """Of SmallDisplacementElement3D4N the name that meshio knows, Tetrahedra3D4; of others nothing."""
    found = re.search(r"([23])D([0-9]+)N", name)
    if not found:
        return None
    surfaces = "1 Point 2 Line 3 Triangle 4 Quadrilateral 6 Triangle 8 Quadrilateral 9 Quadrilateral"
    lines = "1 Point 2 Line 3 Line"
    solids = "2 Line 3 Triangle 4 Tetrahedra 6 Prism 8 Hexahedra 10 Tetrahedra 20 Hexahedra 27 Hexahedra"
    thin = block == "Conditions" or re.search("Shell|Membrane|Surface", name)
    words = ((lines if thin else surfaces) if found[1] == "2" else surfaces if thin else solids).split()
    shape = dict(zip(words[::2], words[1::2])).get(found[2])
    return shape and "%s%sD%s" % (shape, found[1], found[2])


def mdpa_for_meshio(path):
    """Another path, to what meshio understands: it knows few names of elements, and no geometries, of Kratos."""
    with open(path, errors="replace") as file:
        lines = file.read().splitlines()
    inside, out, wrong, count = "", [], None, 0
    has_elements = any(line.split()[:2] in (["Begin", "Elements"], ["Begin", "Conditions"]) for line in lines)
    if has_elements and any(line.split()[:2] == ["Begin", "Geometries"] for line in lines):
        lost.append("geometries, beside the elements and conditions")
    for line in lines:
        words = line.split("//")[0].split()
        if words[:1] == ["Begin"] and len(words) > 1:
            inside = words[1]
            shape = shape_of_kratos(inside, words[2]) if len(words) > 2 else None
            if inside in ("Elements", "Conditions") and shape:
                line = "Begin %s %s" % (inside, shape)
        elif words[:1] == ["End"]:
            inside = ""
        elif inside == "Nodes" and words:
            count += 1
            wrong = wrong or (None if words[0] == str(count) else (words[0], count))
        elif inside == "Geometries" and words:
            line = " ".join([words[0], "0"] + words[1:])
        if words[1:2] == ["Geometries"] and not has_elements:
            line = line.replace("Geometries", "Elements", 1)
        out.append(line)
    if wrong:
        refuse(
            "the numbers of nodes",
            "1, 2, 3 and so on, by which cells refer to them in meshio",
            "node %s in place of %d" % wrong,
            "number the nodes in their order",
        )
    number = os.memfd_create("barycert-mdpa")
    with open(number, "w", closefd=False) as file:
        file.write("\n".join(out) + "\n")
    return "/proc/self/fd/%d" % number


def plain(name, parts, rows):
    """One array of bytes, integers or floats, a row a node or cell; None if that would lose anything."""
    parts = [numpy.asarray(p) for p in parts]
    if any(p.dtype.kind not in "biuf" or p.dtype.itemsize > 8 for p in parts):
        return lost.append(name + ", which holds no numbers of at most 64 bits")
    if not parts or sum(len(p) for p in parts if p.ndim) != rows or len({p.shape[1:] for p in parts}) != 1:
        return lost.append(name + ", which does not have one row for each")
    whole = numpy.concatenate(parts)
    if any((p.astype(whole.dtype).astype(p.dtype) != p)[p == p].any() for p in parts):
        return lost.append(name + ", whose types differ from block to block")
    if whole.dtype.kind == "b" or whole.dtype == numpy.float16:
        whole = whole.astype("u1" if whole.dtype.kind == "b" else "f4")
    return whole.reshape(rows, -1)


def write(file, mesh):
    nodes, cells = len(mesh.points), sum(len(c.data) for c in mesh.cells)
    points = plain("points", [mesh.points], nodes)
    if points is None or points.shape[1] not in (2, 3):
        raise ValueError("points of %s" % (numpy.shape(mesh.points),))
    points = points if points.dtype.kind == "f" else points.astype("f8")
    points = numpy.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    for c in mesh.cells:
        if c.type not in TYPES or getattr(c.data, "ndim", 0) != 2:
            raise ValueError("%d cells of type %s" % (len(c.data), c.type))
    sizes = [c.data.shape for c in mesh.cells] or [(0, 0)]
    sections = [
        ("Points", [("Points", points)]),
        (
            "Cells",
            [
                ("connectivity", numpy.concatenate([numpy.ravel(c.data) for c in mesh.cells] or [[]]).astype("i8")),
                ("offsets", numpy.cumsum(numpy.repeat([s[1] for s in sizes], [s[0] for s in sizes])).astype("i8")),
                ("types", numpy.repeat([TYPES[c.type] for c in mesh.cells] or [0], [s[0] for s in sizes]).astype("u1")),
            ],
        ),
    ]
    rows = {}
    for section, data, count in (
        ("PointData", {k: [v] for k, v in mesh.point_data.items()}, nodes),
        ("CellData", mesh.cell_data, cells),
    ):
        of = "point data " if section == "PointData" else "cell data "
        found = [(k, plain(of + k, v, count)) for k, v in data.items()]
        sections.append((section, [(k, v) for k, v in found if v is not None]))
        rows[section] = {k: list(v.shape) for k, v in sections[-1][1]}
    text, offset = "", 0
    for section, arrays in sections:
        text += "<%s>" % section
        for name, a in arrays:
            kind = {"f": "Float", "i": "Int", "u": "UInt"}[a.dtype.kind] + str(8 * a.dtype.itemsize)
            text += '<DataArray type="%s" Name=%s NumberOfComponents="%d" format="appended" offset="%d"/>' % (
                kind,
                quoteattr(name),
                a.shape[1] if a.ndim == 2 else 1,
                offset,
            )
            offset += 8 + a.nbytes
        text += "</%s>" % section
    file.write(
        (
            '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="%s" header_type="UInt64">'
            '<UnstructuredGrid><Piece NumberOfPoints="%d" NumberOfCells="%d">%s</Piece></UnstructuredGrid>'
            '<AppendedData encoding="raw">_'
            % ("LittleEndian" if sys.byteorder == "little" else "BigEndian", nodes, cells, text)
        ).encode()
    )
    for _, arrays in sections:
        for _, a in arrays:
            a = numpy.ascontiguousarray(a, a.dtype.newbyteorder("="))
            file.write(numpy.uint64(a.nbytes).tobytes())
            file.write(a.data)
    file.write(b"</AppendedData></VTKFile>")
    file.flush()
    for of in ("point_sets", "cell_sets", "field_data"):
        lost.extend(of.replace("_", " ") + " " + str(k) for k in getattr(mesh, of, None) or {})
    types = {}
    for c in mesh.cells:
        types[TYPES[c.type]] = types.get(TYPES[c.type], 0) + len(c.data)
    return dict(nodes=nodes, types=types, rows=rows)


try:
    if kind in ("xdmf", "med", "h5m"):
        watch_hdf5()
    if kind == "abaqus":
        take_all_nodes_of_abaqus()
    if kind == "su2":
        check_su2(path)
    if kind == "mdpa":
        path = mdpa_for_meshio(path)
    sys.addaudithook(opened)
    with os.fdopen(3, "wb") as file:
        read = write(file, meshio.read(path, file_format=kind))
except BaseException as error:
    tell(
        meshio=meshio.__version__,
        module=getattr(error, "name", None) if isinstance(error, ImportError) else None,
        error="%s: %s" % (type(error).__name__, error),
    )
tell(meshio=meshio.__version__, lost=lost, files=files, **read)
