# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""PYTHONPATH=build/python python3 python/packaging/make_stub.py > python/ridgeway/_core.pyi

The names, parameters and defaults come from the module, the types from the tables below; what has
none is an error. A test compares the stub with what this makes.
"""

import inspect
import re

from ridgeway import _core

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
#
# Made by python/packaging/make_stub.py.
import os
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ridgeway._values import Cancelled as Cancelled
from ridgeway._values import Grid, Surface, TrajectorySamples
from ridgeway._values import InputError as InputError

_Path = Union[str, "os.PathLike[str]"]
_Point = Union[Sequence[float], NDArray[Any]]
_Box = Union[Sequence[Sequence[float]], Sequence[float], NDArray[Any]]
_Triple = Tuple[float, float, float]
_Progress = Optional[Callable[[str, float], Any]]

__version__: str
'''

PARAMETERS = {
    "start goal origin start_velocity start_acceleration": "_Point",
    "points path waypoints starts goals places transform T_world_camera T_world_sensor image states "
    "voxels via times": "ArrayLike",
    "bounds keep_in": "Optional[_Box]",
    "boxes keep_out exclude": "Sequence[_Box]",
    "voxel_size free_below occupied_above low high deepest step max_range range_sigma fx fy cx cy "
    "min_clearance max_distance theta least_apart prune_radius split_deviation significance "
    "widest_kept steepness width_step stretch within time_limit prefer_clearance snap robot_height "
    "horizontal vertical nearest range spacing persistence resolved_below kept_clearance until period share_of_range time yaw min_volume latitude longitude altitude x_heading "
    "max_speed max_acceleration max_jerk max_yaw_rate truncation depth_behind min_range max_weight "
    "clear_radius window": "float",
    "radius start_yaw units section_x section_y row_gap": "Optional[float]",
    "unknown planner smoothness integrator source strategy diagram_colour title": "str",
    "up": "Optional[str]", "home": "Optional[_Point]", "band": "Optional[Sequence[float]]",
    "inside": "ArrayLike", "position velocity acceleration point": "_Point", "file": "_Path",
    "paths": "Union[Alternatives, Dict[str, Union[PlanResult, Trajectory, ArrayLike]], None]", "roadmap": "Roadmap",
    "simplify basis_point_edges paper_diagram shorten quick escape follow_yaw stop_and_go carve floors sides narrow_places": "bool",
    "threads count queries seed slot index min_cluster isolated_below tangent_pairs most_evaluations "
    "width height rows columns forget_after log_bytes least_frontier headings most_rays most_stops most_looks": "int",
    "limits": "Optional[FlightLimits]",
    "progress": "_Progress",
    "loading": "Any",
    "log_folder folder": "_Path",
    "esdf": "EsdfMap",
    "diagram traversable gvd": "VoxelMask",
    "graph": "SparseGraph",
    "camera": "PinholeCamera",
    "lidar": "SpinningLidar",
    "before now": "Roadmap",
    "poses": "Dict[int, ArrayLike]",
}
TYPES = {name: kind for names, kind in PARAMETERS.items() for name in names.split()}
# Where a name means something else than usually.
PARTICULAR = {
    "load_map.path": "_Path", "load.path": "_Path", "load_tsdf.path": "_Path", "load_world.path": "_Path",
    "read_path.path": "_Path", "Roadmap.read_plan.path": "_Path",
    "Roadmap.explain.start": "Union[PlanResult, _Point]", "Roadmap.explain.goal": "Optional[_Point]",
    "PinholeCamera.__init__.fx": "Optional[float]", "PinholeCamera.__init__.fy": "Optional[float]",
    "PinholeCamera.__init__.cx": "Optional[float]", "PinholeCamera.__init__.cy": "Optional[float]",
    "Roadmap.save.path": "_Path", "Roadmap.export_graph.path": "_Path", "TsdfMap.save.path": "_Path",
    "Trajectory.save.path": "_Path", "PlanResult.save.path": "_Path", "PlanResult.save_mission.path": "_Path",
    "Roadmap.export_voxblox.path": "_Path", "TsdfMap.export_voxblox.path": "_Path",
    "TsdfMap.save_surface.path": "_Path", "EsdfMap.surroundings.radius": "float",
    "Explorer.__init__.within": "Optional[ArrayLike]",
    "Roadmap.draw.path": "Union[PlanResult, Trajectory, ArrayLike, None]", "Roadmap.draw.diagram": "bool",
    "Roadmap.draw.graph": "bool",
    "build.map": "Union[OccupancyMap, _Path]", "compute_esdf.map": "OccupancyMap",
    "Roadmap.trajectory.path": "Union[PlanResult, ArrayLike]",
    "load_map.voxel_size": "Optional[float]", "OccupancyMap.transformed.voxel_size": "Optional[float]",
    "load_map.transform": "Optional[ArrayLike]", "OccupancyMap.from_points.transform": "Optional[ArrayLike]",
    "OccupancyMap.from_points.bounds": "_Box", "OccupancyMap.cropped.bounds": "_Box",
    "World.occupancy.bounds": "_Box", "thin.voxels": "VoxelMask",
    "TsdfFusion.__init__.origin": "Optional[_Point]", "LiveRoadmap.__init__.origin": "Optional[_Point]",
    "EsdfMap.path_is_free.path": "Union[PlanResult, ArrayLike]", "EsdfMap.clearance.path": "Union[PlanResult, ArrayLike]",
    "EsdfMap.surroundings.path": "Union[PlanResult, ArrayLike]",
    "GraphDelta.may_invalidate.path": "Union[PlanResult, ArrayLike]",
    "EsdfMap.is_free.radius": "float", "EsdfMap.path_is_free.radius": "float",
    "traversable_voxels.radius": "float", "GraphDelta.may_invalidate.radius": "Optional[float]",
    "Roadmap.still_safe.path": "PlanResult",
}
RETURNS = {
    "build load": "Roadmap", "load_map": "OccupancyMap", "load_tsdf": "TsdfMap", "load_world": "World",
    "read_path": "NDArray[np.float64]", "open_sequence": "DepthSequence", "open_scans": "ScanSequence",
    "field_of_view surroundings describe": "Dict[str, Any]", "decide": "ExplorationStep",
    "unseen frontiers": "List[Dict[str, Any]]", "compute_esdf": "EsdfMap", "delta_between": "GraphDelta",
    "traversable_voxels compute_gvd extract_edges thin compute_skeleton": "VoxelMask",
    "build_graph simplify_graph": "SparseGraph",
    "from_numpy from_points resampled cropped with_no_fly without_isolated without_pockets flattened transformed "
    "occupancy": "OccupancyMap",
    "to_numpy distances states": "Grid", "state_at": "NDArray[np.uint8]",
    "is_free": "NDArray[np.bool_]", "path_is_free may_invalidate still_safe is_correction_ready": "bool", "clearance": "float",
    "distance_at": "Tuple[NDArray[np.float64], NDArray[np.float64]]", "block": "NDArray[np.uint32]",
    "plan": "PlanResult", "plan_many": "List[PlanResult]",
    "plan_nearest": "Tuple[Optional[int], PlanResult]", "plan_via": "Tuple[PlanResult, Optional[int]]",
    "alternatives": "Alternatives", "explain": "Optional[BlockedRoute]", "read_plan": "PlanResult", "trajectory": "Trajectory",
    "save save_mission add finish save_surface export_graph export_voxblox draw begin_correcting": "None",
    "components": "List[Dict[str, Any]]",
    "check integrate_depth integrate_points set_voxels correct_poses finish_correcting catch_up":
        "Dict[str, Any]",
    "sample at": "TrajectorySamples", "surface": "Surface", "scan_with": "NDArray[np.float64]", "to_networkx": "Any",
    "snapshot settled": "Optional[Roadmap]", "render_depth": "NDArray[np.float32]",
    "__len__": "int", "__bool__ __eq__": "bool", "__repr__": "str", "__init__": "None",
    "map": "OccupancyMap",
}
RESULTS = {name: kind for names, kind in RETURNS.items() for name in names.split()}
RESULTS.update({"TsdfFusion.map": "TsdfMap", "Roadmap.distances": "NDArray[np.float64]",
                "TsdfFusion.integrate_depth": "None", "TsdfFusion.integrate_points": "None",
                "Alternatives.__getitem__": "PlanResult", "Alternatives.__iter__": "Iterator[PlanResult]",
                "ScanSequence.__iter__": "Iterator[Tuple[NDArray[np.float64], NDArray[np.float64]]]",
                "DepthSequence.__iter__": "Iterator[Tuple[NDArray[np.float32], NDArray[np.float64]]]",
                "ScanSequence.__getitem__": "Tuple[NDArray[np.float64], NDArray[np.float64]]",
                "DepthSequence.__getitem__": "Tuple[NDArray[np.float32], NDArray[np.float64]]"})
PROPERTIES = {
    "bounds": "Optional[Tuple[_Triple, _Triple]]", "keep_in": "Tuple[_Triple, _Triple]",
    "keep_out": "List[Tuple[_Triple, _Triple]]", "map_end": "Optional[_Triple]", "place": "Optional[_Triple]",
    "counts": "Dict[str, int]", "seconds": "Dict[str, float]", "config": "Dict[str, Any]",
    "report": "Optional[Dict[str, Any]]",
    "vertices points waypoints block_corners distances durations coefficients tour edge_lengths "
    "edge_clearances vertex_clearances": "NDArray[np.float64]",
    "edges components block_squared": "NDArray[np.uint32]", "voxels": "NDArray[np.int32]",
    "block_states": "NDArray[np.uint8]", "block_sites": "NDArray[np.int16]",
    "block_distances block_weights": "NDArray[np.float32]",
    "voxel_size min_clearance max_distance truncation length clearance within radius duration "
    "max_speed max_acceleration max_jerk max_yaw_rate escape_start escape_goal moved_start moved_goal "
    "fx fy cx cy vertical min_range max_range range_sigma tour_seconds": "float", "goal": "Optional[Tuple[float, float, float, float]]",
    "source unknown status reason answered_by by step name layout": "str",
    "planar ok complete is_settled is_empty was_in_doubt is_braking": "bool", "stops width height rows columns without_pose frontiers frontier_voxels": "int",
    "esdf": "EsdfMap", "diagram": "VoxelMask", "graph": "SparseGraph", "camera": "PinholeCamera",
}
ATTRIBUTES = {name: kind for names, kind in PROPERTIES.items() for name in names.split()}
ATTRIBUTES["Alternatives.seconds"] = "float"


def parameters(where, signature):
    words, had_star = [], False
    for parameter in signature.parameters.values():
        if parameter.name == "self":
            continue
        kind = PARTICULAR.get(f"{where}.{parameter.name}") or TYPES[parameter.name]
        if parameter.kind is parameter.KEYWORD_ONLY and not had_star:
            words.append("*")
            had_star = True
        prefix = "**" if parameter.kind is parameter.VAR_KEYWORD else ""
        default = "" if parameter.default is parameter.empty else " = ..."
        words.append(f"{prefix}{parameter.name}: {kind}{default}")
    return words


def function(where, indent, words, result, static=False):
    first = [] if static or not indent else ["self"]
    name = where.split(".")[-1]
    text = f"{indent}def {name}({', '.join(first + words)}) -> {result}: ..."
    if len(text) > 100:
        inner = f",\n{indent}    ".join(first + words)
        text = f"{indent}def {name}(\n{indent}    {inner},\n{indent}) -> {result}: ..."
    return (f"{indent}@staticmethod\n" if static else "") + text + "\n"


def stub_of(cls):
    own, lines = vars(cls), []
    for name, member in own.items():
        where = f"{cls.__name__}.{name}"
        if isinstance(member, property):
            kind = ATTRIBUTES.get(where) or ATTRIBUTES[name]
            lines.append(f"    @property\n    def {name}(self) -> {kind}: ...\n")
        elif name == "__init__":
            if cls.__text_signature__:
                words = parameters(where, inspect.signature(cls))
                lines.append(function(where, "    ", words, "None"))
        elif name in ("__len__", "__bool__", "__repr__"):
            lines.append(function(where, "    ", [], RESULTS[name]))
        elif name == "__eq__":
            lines.append(function(where, "    ", ["other: object"], "bool"))
            lines.append("    __hash__: None  # type: ignore\n")
        elif name == "__enter__":
            lines.append(function(where, "    ", [], cls.__name__))
        elif name == "__exit__":
            lines.append(function(where, "    ", ["error: object", "value: object", "traceback: object"], "None"))
        elif name == "__getitem__":
            for index, result in (("int", RESULTS[where]), ("slice", f"List[{RESULTS[where]}]")):
                lines.append("    @overload\n" + function(where, "    ", [f"index: {index}"], result))
        elif name == "__iter__":
            lines.append(function(where, "    ", [], RESULTS[where]))
        elif not name.startswith("_"):
            static = isinstance(member, staticmethod)
            words = parameters(where, inspect.signature(getattr(cls, name)))
            lines.append(function(where, "    ", words, RESULTS.get(where) or RESULTS[name], static))
    return f"\nclass {cls.__name__}:\n" + ("".join(lines) or "    ...\n")


def make():
    text = HEAD
    for name, value in vars(_core).items():
        if inspect.isclass(value) and not issubclass(value, Exception):
            text += stub_of(value)
    for name, value in vars(_core).items():
        if inspect.isbuiltin(value):
            text += "\n" + function(name, "", parameters(name, inspect.signature(value)), RESULTS[name])
    return re.sub(r"\n{3,}", "\n\n", text)


if __name__ == "__main__":
    print(make(), end="")
