"""What to do with files that cannot be read."""

from collections.abc import Sequence

_EXPORT = "export the points as .e57, .ply or .xyz in"
# By suffix: what it is, and the program that makes of it what can be read.
_ADVICE = {
    ".rcp": f"a project of Autodesk ReCap; {_EXPORT} it",
    ".rcs": f"a scan of Autodesk ReCap; {_EXPORT} it",
    ".fls": f"a scan of FARO; {_EXPORT} FARO SCENE",
    ".lsproj": f"a project of FARO SCENE; {_EXPORT} it",
    ".zfs": f"a scan of Zoller+Froehlich; {_EXPORT} their LaserControl",
    ".imp": f"a database of Leica Cyclone; {_EXPORT} it",
    ".rdbx": f"a database of RIEGL; {_EXPORT} RiSCAN PRO",
    ".3dd": f"a scan of RIEGL; {_EXPORT} RiSCAN PRO",
    ".bin": f"mostly a file of CloudCompare; {_EXPORT} it",
    ".mlp": f"a project of MeshLab; {_EXPORT} it",
    ".drc": "compressed by Draco; unpack it by draco_decoder -i FILE.drc -o FILE.ply",
    ".splat": "made of Gaussian splats; save it as .ply in SuperSplat",
    ".ksplat": "made of Gaussian splats; save it as .ply in SuperSplat",
    ".bag": "a recording of a sensor; save a frame as .ply in RealSense Viewer, or .pcd by pcl_ros bag_to_pcd",
    ".db3": "a recording of ROS 2; save a frame as .pcd",
    ".step": "a CAD model and no scan; mesh it in FreeCAD and save it as .stl",
    ".stp": "a CAD model and no scan; mesh it in FreeCAD and save it as .stl",
    ".iges": "a CAD model and no scan; mesh it in FreeCAD and save it as .stl",
    ".igs": "a CAD model and no scan; mesh it in FreeCAD and save it as .stl",
    ".dxf": "a drawing; save its points as .csv or its mesh as .stl in FreeCAD or QCAD",
    ".dwg": "a drawing; save its points as .csv or its mesh as .stl in a CAD program",
    ".fbx": "a scene; save it as .glb or .obj in Blender",
    ".blend": "a scene; save it as .glb or .obj in Blender",
    ".gltf": "a scene beside its data; save it as .glb in Blender",
    ".dae": "a scene; save it as .glb or .obj in Blender or MeshLab",
    ".3ds": "a scene; save it as .glb or .obj in Blender or MeshLab",
    ".wrl": "a scene; save it as .ply in MeshLab",
    ".3mf": "a model for printing; save it as .stl in a slicer or in MeshLab",
    ".zip": "an archive; unpack it first",
    ".7z": "an archive; unpack it first",
    ".rar": "an archive; unpack it first",
    ".tar": "an archive; unpack it first",
    ".xlsx": "a workbook; save the sheet as .csv",
    ".xls": "a workbook; save the sheet as .csv",
    ".ods": "a workbook; save the sheet as .csv",
    ".mat": "a file of MATLAB; save the points by writematrix(points, 'scan.csv')",
    ".h5": "a file of HDF5; save the points by numpy.save",
    ".parquet": "a table; save it as .csv",
}


def advice_on(suffix: str, readable: Sequence[str]) -> str:
    """Say of a suffix that cannot be read what it is and what to do, or which can be read.

    >>> advice_on(".rcs", [".ply"])
    'this is a scan of Autodesk ReCap; export the points as .e57, .ply or .xyz in it'
    >>> advice_on(".foo", [".ply", ".xyz"])
    "the suffix '.foo' is none of the 2 that can be read: .ply, .xyz"
    """
    if suffix in _ADVICE:
        return f"this is {_ADVICE[suffix]}"
    return f"the suffix '{suffix}' is none of the {len(readable)} that can be read: {', '.join(readable)}"
