"""sbom_test.py SBOM_PY BUILD NINJA WORK: the bill of materials of what was built is SPDX 2.3 and names what the program
needs. Where python3-jsonschema and SPDX_SCHEMA, a file, are there, that schema is asked, too."""

import json
import os
import re
import shutil
import subprocess
import sys

sbom, build, ninja, work = sys.argv[1:]
if not shutil.which("dpkg"):
    print("this system has no packages of Debian")
    sys.exit(77)
os.makedirs(work, exist_ok=True)


def bill(package, *parts):
    output = os.path.join(work, package + ".spdx.json")
    environment = dict(os.environ, SOURCE_DATE_EPOCH="1700000000")
    subprocess.run(
        [sys.executable, sbom, "--build", build, "--ninja", ninja, "--package", package, "--version", "0-1"]
        + ["--notices", os.path.join(work, "notices"), "--output", output, *parts],
        check=True,
        env=environment,
    )
    with open(output, encoding="utf-8") as file:
        return json.load(file)


def check_form(document):
    """What the specification asks of each element; references lead somewhere."""
    assert document["spdxVersion"] == "SPDX-2.3" and document["dataLicense"] == "CC0-1.0"
    assert document["SPDXID"] == "SPDXRef-DOCUMENT" and document["name"]
    assert re.fullmatch(r"https://[^#]+", document["documentNamespace"])
    assert document["creationInfo"]["created"] == "2023-11-14T22:13:20Z"
    assert all(re.match(r"(Tool|Person|Organization): ", c) for c in document["creationInfo"]["creators"])
    identifiers = [p["SPDXID"] for p in document["packages"]]
    assert len(set(identifiers)) == len(identifiers)
    assert all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", i) for i in identifiers)
    extracted = {e["licenseId"] for e in document.get("hasExtractedLicensingInfos", [])}
    for package in document["packages"]:
        assert package["name"] and package["versionInfo"] and package["downloadLocation"]
        assert package["filesAnalyzed"] is False
        for word in re.split(r" (?:AND|OR|WITH) ", package["licenseConcluded"]):
            assert re.fullmatch(r"[A-Za-z0-9.+-]+", word), word
            assert not word.startswith("LicenseRef-") or word in extracted, word
    for r in document["relationships"]:
        for end in ("spdxElementId", "relatedSpdxElement"):
            assert r[end] in identifiers or r[end] == "SPDXRef-DOCUMENT", r
    described = [r for r in document["relationships"] if r["relationshipType"] == "DESCRIBES"]
    assert len(described) == 1 and described[0]["relatedSpdxElement"] == identifiers[0]
    if os.environ.get("SPDX_SCHEMA"):
        import jsonschema

        with open(os.environ["SPDX_SCHEMA"], encoding="utf-8") as file:
            jsonschema.validate(document, json.load(file))


def licences(document):
    return {p["name"]: p["licenseConcluded"] for p in document["packages"]}


program = bill("barycert", "bin/barycert")
check_form(program)
of = licences(program)
# The libraries that the loader names are all there, and nothing of TetGen's.
needed = set(re.findall(r"\[(lib[a-z0-9]+)", subprocess.run(
    ["readelf", "-d", os.path.join(build, "bin/barycert")], check=True, capture_output=True, text=True).stdout))
assert len(needed) >= 8, needed
linked = [r["relatedSpdxElement"] for r in program["relationships"] if r["relationshipType"] == "DYNAMIC_LINK"]
assert any("libtbb" in name for name in linked) and any("libc6" in name for name in linked), linked
assert not any("tet" in name for name in of), of
if any(name.startswith("libcgal") for name in of):
    assert of["barycert"] == "Apache-2.0 AND LGPL-3.0-or-later"
    assert "LGPL-3.0-or-later" in next(licence for name, licence in of.items() if name.startswith("libcgal"))
    assert not any(re.search(r"(^|\W)GPL", l) for n, l in of.items() if n.startswith("libcgal"))
else:
    assert of["barycert"] == "Apache-2.0"
for name in ("libeigen3-dev", "three.js", "DejaVu-Sans"):
    assert os.path.exists(os.path.join(work, "notices", name + ".gz")), name
assert of["three.js"] == "MIT" and of["DejaVu Sans"] == "Bitstream-Vera"
if os.path.exists(os.path.join(build, "bin/barycert-tetgen")):
    mesher = bill("barycert-tetgen", "bin/barycert-tetgen")
    check_form(mesher)
    assert licences(mesher)["barycert-tetgen"] == "AGPL-3.0-or-later"
    assert not any(name.startswith("libcgal") for name in licences(mesher))
# A library has what it is made of; a package that brings others has nothing.
core = licences(bill("libbarycert-core-dev", "src/core/libbarycert_core.a"))
assert "libhwy-dev" in core and not {"DejaVu Sans", "libtbb-dev", "libcairo2-dev"} & set(core), core
assert list(licences(bill("libbarycert-dev"))) == ["libbarycert-dev"]
print("bills of materials:", ", ".join(sorted(of)))
