# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
#
# Made by python/packaging/make_stub.py.
import os
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Tuple, Union

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

class OccupancyMap:
    @staticmethod
    def from_numpy(
        states: ArrayLike,
        voxel_size: float,
        origin: _Point = ...,
        free_below: float = ...,
        occupied_above: float = ...,
    ) -> OccupancyMap: ...
    @staticmethod
    def from_points(
        points: ArrayLike,
        voxel_size: float,
        bounds: _Box,
        transform: Optional[ArrayLike] = ...,
    ) -> OccupancyMap: ...
    def to_numpy(self, bounds: Optional[_Box] = ...) -> Grid: ...
    def state_at(self, points: ArrayLike) -> NDArray[np.uint8]: ...
    @property
    def voxel_size(self) -> float: ...
    @property
    def source(self) -> str: ...
    @property
    def planar(self) -> bool: ...
    @property
    def bounds(self) -> Optional[Tuple[_Triple, _Triple]]: ...
    @property
    def counts(self) -> Dict[str, int]: ...
    @property
    def block_corners(self) -> NDArray[np.float64]: ...
    @property
    def block_states(self) -> NDArray[np.uint8]: ...
    def __repr__(self) -> str: ...
    def resampled(self, voxel_size: float) -> OccupancyMap: ...
    def cropped(self, bounds: _Box) -> OccupancyMap: ...
    def with_no_fly(self, boxes: Iterable[_Box]) -> OccupancyMap: ...
    def without_isolated(self, min_cluster: int) -> OccupancyMap: ...
    def without_pockets(self, min_volume: float) -> OccupancyMap: ...
    def flattened(self, low: float, high: float) -> OccupancyMap: ...
    def transformed(
        self,
        transform: ArrayLike,
        voxel_size: Optional[float] = ...,
    ) -> OccupancyMap: ...

class FlightLimits:
    def __init__(self, keep_in: Optional[_Box] = ..., keep_out: Iterable[_Box] = ...) -> None: ...
    @property
    def keep_in(self) -> Tuple[_Triple, _Triple]: ...
    @property
    def keep_out(self) -> List[Tuple[_Triple, _Triple]]: ...
    def __eq__(self, other: object) -> bool: ...
    __hash__: None  # type: ignore
    def __repr__(self) -> str: ...

class EsdfMap:
    def distances(self, bounds: Optional[_Box] = ...) -> Grid: ...
    def states(self, bounds: Optional[_Box] = ...) -> Grid: ...
    def distance_at(
        self,
        points: ArrayLike,
        deepest: float = ...,
    ) -> Tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def is_free(self, points: ArrayLike, radius: float) -> NDArray[np.bool_]: ...
    def path_is_free(self, path: ArrayLike, radius: float) -> bool: ...
    def clearance(self, path: ArrayLike) -> float: ...
    def surroundings(self, path: ArrayLike, radius: float) -> Dict[str, Any]: ...
    @property
    def voxel_size(self) -> float: ...
    @property
    def unknown(self) -> str: ...
    @property
    def max_distance(self) -> float: ...
    @property
    def block_corners(self) -> NDArray[np.float64]: ...
    @property
    def block_states(self) -> NDArray[np.uint8]: ...
    @property
    def block_squared(self) -> NDArray[np.uint32]: ...
    @property
    def block_sites(self) -> NDArray[np.int16]: ...
    def block(self, slot: int) -> NDArray[np.uint32]: ...
    def __repr__(self) -> str: ...

class VoxelMask:
    def __len__(self) -> int: ...
    @property
    def voxels(self) -> NDArray[np.int32]: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def distances(self) -> NDArray[np.float64]: ...
    def to_numpy(self, bounds: Optional[_Box] = ...) -> Grid: ...
    def __eq__(self, other: object) -> bool: ...
    __hash__: None  # type: ignore
    def __repr__(self) -> str: ...

class SparseGraph:
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def edges(self) -> NDArray[np.uint32]: ...
    @property
    def vertex_clearances(self) -> NDArray[np.float64]: ...
    @property
    def edge_lengths(self) -> NDArray[np.float64]: ...
    @property
    def edge_clearances(self) -> NDArray[np.float64]: ...
    @property
    def components(self) -> NDArray[np.uint32]: ...
    @property
    def min_clearance(self) -> float: ...
    def to_networkx(self) -> Any: ...
    def __repr__(self) -> str: ...

class PlanResult:
    @property
    def status(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def ok(self) -> bool: ...
    def __bool__(self) -> bool: ...
    @property
    def waypoints(self) -> NDArray[np.float64]: ...
    @property
    def length(self) -> float: ...
    @property
    def clearance(self) -> float: ...
    @property
    def within(self) -> float: ...
    @property
    def answered_by(self) -> str: ...
    @property
    def unknown(self) -> str: ...
    @property
    def seconds(self) -> Dict[str, float]: ...
    @property
    def escape_start(self) -> float: ...
    @property
    def escape_goal(self) -> float: ...
    @property
    def moved_start(self) -> float: ...
    @property
    def moved_goal(self) -> float: ...
    def save(self, path: _Path) -> None: ...
    def save_mission(
        self,
        path: _Path,
        latitude: float,
        longitude: float,
        altitude: float = ...,
        x_heading: float = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...

class Alternatives:
    @property
    def status(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def complete(self) -> bool: ...
    @property
    def seconds(self) -> float: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> PlanResult: ...
    def __repr__(self) -> str: ...

class BlockedRoute:
    @property
    def radius(self) -> float: ...
    @property
    def place(self) -> Optional[_Triple]: ...
    @property
    def by(self) -> str: ...
    def __repr__(self) -> str: ...

class Roadmap:
    @property
    def esdf(self) -> EsdfMap: ...
    @property
    def diagram(self) -> VoxelMask: ...
    @property
    def graph(self) -> SparseGraph: ...
    @property
    def min_clearance(self) -> float: ...
    @property
    def voxel_size(self) -> float: ...
    @property
    def is_settled(self) -> bool: ...
    @property
    def source(self) -> str: ...
    @property
    def config(self) -> Dict[str, Any]: ...
    @property
    def report(self) -> Optional[Dict[str, Any]]: ...
    def plan(
        self,
        start: _Point,
        goal: _Point,
        *,
        radius: Optional[float] = ...,
        planner: str = ...,
        shorten: bool = ...,
        quick: bool = ...,
        within: float = ...,
        time_limit: float = ...,
        prefer_clearance: float = ...,
        escape: bool = ...,
        limits: Optional[FlightLimits] = ...,
        snap: float = ...,
        robot_height: float = ...,
    ) -> PlanResult: ...
    def plan_many(
        self,
        starts: ArrayLike,
        goals: ArrayLike,
        *,
        threads: int = ...,
        radius: Optional[float] = ...,
        planner: str = ...,
        shorten: bool = ...,
        quick: bool = ...,
        within: float = ...,
        time_limit: float = ...,
        prefer_clearance: float = ...,
        escape: bool = ...,
        limits: Optional[FlightLimits] = ...,
        snap: float = ...,
        robot_height: float = ...,
    ) -> List[PlanResult]: ...
    def plan_nearest(
        self,
        start: _Point,
        goals: ArrayLike,
        *,
        radius: Optional[float] = ...,
        planner: str = ...,
        shorten: bool = ...,
        quick: bool = ...,
        within: float = ...,
        time_limit: float = ...,
        prefer_clearance: float = ...,
        escape: bool = ...,
        limits: Optional[FlightLimits] = ...,
        snap: float = ...,
        robot_height: float = ...,
    ) -> Tuple[Optional[int], PlanResult]: ...
    def plan_via(
        self,
        places: ArrayLike,
        *,
        radius: Optional[float] = ...,
        planner: str = ...,
        shorten: bool = ...,
        quick: bool = ...,
        within: float = ...,
        time_limit: float = ...,
        prefer_clearance: float = ...,
        escape: bool = ...,
        limits: Optional[FlightLimits] = ...,
        snap: float = ...,
        robot_height: float = ...,
    ) -> Tuple[PlanResult, Optional[int]]: ...
    def alternatives(
        self,
        start: _Point,
        goal: _Point,
        count: int = ...,
        *,
        radius: Optional[float] = ...,
        planner: str = ...,
        shorten: bool = ...,
        quick: bool = ...,
        within: float = ...,
        time_limit: float = ...,
        prefer_clearance: float = ...,
        escape: bool = ...,
        limits: Optional[FlightLimits] = ...,
        snap: float = ...,
        robot_height: float = ...,
    ) -> Alternatives: ...
    def distances(
        self,
        start: _Point,
        goals: ArrayLike,
        radius: Optional[float] = ...,
    ) -> NDArray[np.float64]: ...
    def explain(
        self,
        start: _Point,
        goal: _Point,
        radius: Optional[float] = ...,
        limits: Optional[FlightLimits] = ...,
    ) -> Optional[BlockedRoute]: ...
    def trajectory(
        self,
        path: Union[PlanResult, ArrayLike],
        radius: Optional[float] = ...,
        *,
        max_speed: float = ...,
        max_acceleration: float = ...,
        max_jerk: float = ...,
        max_yaw_rate: float = ...,
        smoothness: str = ...,
        start_velocity: _Point = ...,
        start_acceleration: _Point = ...,
        start_yaw: Optional[float] = ...,
        follow_yaw: bool = ...,
        flight_limits: Optional[FlightLimits] = ...,
        robot_height: float = ...,
        stop_and_go: bool = ...,
        most_evaluations: int = ...,
    ) -> Trajectory: ...
    def draw(
        self,
        file: _Path,
        path: Union[PlanResult, ArrayLike, None] = ...,
        paths: Optional[Dict[str, Union[PlanResult, ArrayLike]]] = ...,
        *,
        width: int = ...,
        band: Optional[Sequence[float]] = ...,
        floors: bool = ...,
        sides: bool = ...,
        section_y: Optional[float] = ...,
        section_x: Optional[float] = ...,
        diagram: bool = ...,
        graph: bool = ...,
        narrow_places: bool = ...,
        diagram_colour: str = ...,
        title: str = ...,
    ) -> None: ...
    def save(self, path: _Path) -> None: ...
    def export_graph(self, path: _Path) -> None: ...
    def export_voxblox(self, path: _Path) -> None: ...
    def describe(self, point: _Point) -> Dict[str, Any]: ...
    def components(self) -> List[Dict[str, Any]]: ...
    def check(
        self,
        queries: int = ...,
        seed: int = ...,
        progress: _Progress = ...,
    ) -> Dict[str, Any]: ...
    def __repr__(self) -> str: ...

class Trajectory:
    @property
    def status(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def ok(self) -> bool: ...
    def __bool__(self) -> bool: ...
    @property
    def duration(self) -> float: ...
    @property
    def clearance(self) -> float: ...
    @property
    def max_speed(self) -> float: ...
    @property
    def max_acceleration(self) -> float: ...
    @property
    def max_jerk(self) -> float: ...
    @property
    def max_yaw_rate(self) -> float: ...
    @property
    def stops(self) -> int: ...
    @property
    def step(self) -> str: ...
    @property
    def durations(self) -> NDArray[np.float64]: ...
    @property
    def coefficients(self) -> NDArray[np.float64]: ...
    def sample(self, step: float = ...) -> TrajectorySamples: ...
    def save(self, path: _Path, step: float = ...) -> None: ...
    def __repr__(self) -> str: ...

class PinholeCamera:
    def __init__(
        self,
        width: int = ...,
        height: int = ...,
        fx: float = ...,
        fy: float = ...,
        cx: float = ...,
        cy: float = ...,
    ) -> None: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def fx(self) -> float: ...
    @property
    def fy(self) -> float: ...
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    def __repr__(self) -> str: ...

class DepthSequence:
    @property
    def layout(self) -> str: ...
    @property
    def camera(self) -> PinholeCamera: ...
    @property
    def without_pose(self) -> int: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Tuple[NDArray[np.float32], NDArray[np.float64]]: ...
    def __repr__(self) -> str: ...

class ScanSequence:
    @property
    def layout(self) -> str: ...
    @property
    def without_pose(self) -> int: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def __repr__(self) -> str: ...

class World:
    @property
    def name(self) -> str: ...
    def occupancy(self, voxel_size: float, bounds: _Box) -> OccupancyMap: ...
    def render_depth(
        self,
        camera: PinholeCamera,
        T_world_camera: ArrayLike,
        max_range: float = ...,
        range_sigma: float = ...,
        seed: int = ...,
    ) -> NDArray[np.float32]: ...
    def __repr__(self) -> str: ...

class TsdfMap:
    @property
    def voxel_size(self) -> float: ...
    @property
    def truncation(self) -> float: ...
    @property
    def block_corners(self) -> NDArray[np.float64]: ...
    @property
    def block_distances(self) -> NDArray[np.float32]: ...
    @property
    def block_weights(self) -> NDArray[np.float32]: ...
    def occupancy(self) -> OccupancyMap: ...
    def surface(self) -> Surface: ...
    def save_surface(self, path: _Path) -> None: ...
    def export_voxblox(self, path: _Path) -> None: ...
    def save(self, path: _Path, source: str = ...) -> None: ...
    def __repr__(self) -> str: ...

class TsdfFusion:
    def __init__(
        self,
        *,
        voxel_size: float = ...,
        truncation: float = ...,
        depth_behind: float = ...,
        min_range: float = ...,
        max_range: float = ...,
        carve: bool = ...,
        max_weight: float = ...,
        forget_after: int = ...,
        clear_radius: float = ...,
        integrator: str = ...,
        origin: Optional[_Point] = ...,
    ) -> None: ...
    def integrate_depth(
        self,
        image: ArrayLike,
        camera: PinholeCamera,
        T_world_camera: ArrayLike,
    ) -> None: ...
    def integrate_points(self, points: ArrayLike, T_world_sensor: ArrayLike) -> None: ...
    def map(self) -> TsdfMap: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...

class GraphDelta:
    @property
    def is_empty(self) -> bool: ...
    @property
    def counts(self) -> Dict[str, int]: ...
    def may_invalidate(self, path: ArrayLike, radius: float) -> bool: ...
    def __repr__(self) -> str: ...

class LiveRoadmap:
    def __init__(
        self,
        *,
        voxel_size: float = ...,
        truncation: float = ...,
        depth_behind: float = ...,
        min_range: float = ...,
        max_range: float = ...,
        carve: bool = ...,
        max_weight: float = ...,
        forget_after: int = ...,
        clear_radius: float = ...,
        integrator: str = ...,
        min_clearance: float = ...,
        unknown: str = ...,
        max_distance: float = ...,
        limits: Optional[FlightLimits] = ...,
        theta: float = ...,
        least_apart: float = ...,
        prune_radius: float = ...,
        split_deviation: float = ...,
        significance: float = ...,
        simplify: bool = ...,
        tangent_pairs: int = ...,
        basis_point_edges: bool = ...,
        paper_diagram: bool = ...,
        origin: Optional[_Point] = ...,
        window: float = ...,
        log_folder: _Path = ...,
        log_bytes: int = ...,
    ) -> None: ...
    def integrate_depth(
        self,
        image: ArrayLike,
        camera: PinholeCamera,
        T_world_camera: ArrayLike,
    ) -> Dict[str, Any]: ...
    def integrate_points(self, points: ArrayLike, T_world_sensor: ArrayLike) -> Dict[str, Any]: ...
    def set_voxels(self, voxels: ArrayLike, states: ArrayLike) -> Dict[str, Any]: ...
    def correct_poses(self, poses: Dict[int, ArrayLike]) -> Dict[str, Any]: ...
    def catch_up(self) -> Dict[str, Any]: ...
    def snapshot(self) -> Optional[Roadmap]: ...
    def settled(self) -> Optional[Roadmap]: ...
    def map(self) -> OccupancyMap: ...
    def __repr__(self) -> str: ...

class ExplorationStep:
    @property
    def status(self) -> str: ...
    def __bool__(self) -> bool: ...
    @property
    def duration(self) -> float: ...
    @property
    def durations(self) -> NDArray[np.float64]: ...
    @property
    def coefficients(self) -> NDArray[np.float64]: ...
    def sample(self, step: float = ...) -> TrajectorySamples: ...
    @property
    def goal(self) -> Optional[Tuple[float, float, float, float]]: ...
    @property
    def tour(self) -> NDArray[np.float64]: ...
    @property
    def tour_seconds(self) -> float: ...
    @property
    def was_in_doubt(self) -> bool: ...
    @property
    def is_braking(self) -> bool: ...
    @property
    def frontiers(self) -> int: ...
    @property
    def frontier_voxels(self) -> int: ...
    @property
    def seconds(self) -> Dict[str, float]: ...
    def __repr__(self) -> str: ...

class Explorer:
    def __init__(
        self,
        *,
        max_speed: float = ...,
        max_acceleration: float = ...,
        max_jerk: float = ...,
        max_yaw_rate: float = ...,
        horizontal: float = ...,
        vertical: float = ...,
        nearest: float = ...,
        range: float = ...,
        within: Optional[ArrayLike] = ...,
        least_frontier: int = ...,
        spacing: float = ...,
        headings: int = ...,
        strategy: str = ...,
        persistence: float = ...,
        resolved_below: float = ...,
        most_rays: int = ...,
        most_stops: int = ...,
        kept_clearance: float = ...,
        most_looks: int = ...,
        home: Optional[_Point] = ...,
        until: float = ...,
    ) -> None: ...
    def decide(
        self,
        roadmap: Roadmap,
        time: float,
        position: _Point,
        velocity: _Point = ...,
        acceleration: _Point = ...,
        yaw: float = ...,
    ) -> ExplorationStep: ...
    def unseen(self) -> List[Dict[str, Any]]: ...
    def frontiers(self) -> List[Dict[str, Any]]: ...
    def __repr__(self) -> str: ...

def load_map(
    path: _Path,
    *,
    voxel_size: Optional[float] = ...,
    bounds: Optional[_Box] = ...,
    exclude: Iterable[_Box] = ...,
    transform: Optional[ArrayLike] = ...,
    units: Optional[float] = ...,
    up: Optional[str] = ...,
    inside: ArrayLike = ...,
    isolated_below: int = ...,
) -> OccupancyMap: ...

def compute_esdf(
    map: OccupancyMap,
    *,
    threads: int = ...,
    unknown: str = ...,
    max_distance: float = ...,
    limits: Optional[FlightLimits] = ...,
) -> EsdfMap: ...

def traversable_voxels(esdf: EsdfMap, radius: float) -> VoxelMask: ...

def compute_gvd(
    esdf: EsdfMap,
    traversable: VoxelMask,
    *,
    theta: float = ...,
    least_apart: float = ...,
) -> VoxelMask: ...

def extract_edges(esdf: EsdfMap, gvd: VoxelMask) -> VoxelMask: ...

def thin(voxels: VoxelMask) -> VoxelMask: ...

def compute_skeleton(
    esdf: EsdfMap,
    min_clearance: float = ...,
    *,
    theta: float = ...,
    least_apart: float = ...,
) -> VoxelMask: ...

def build_graph(
    esdf: EsdfMap,
    diagram: VoxelMask,
    *,
    min_clearance: float = ...,
    prune_radius: float = ...,
    split_deviation: float = ...,
    widest_kept: float = ...,
) -> SparseGraph: ...

def simplify_graph(
    esdf: EsdfMap,
    graph: SparseGraph,
    *,
    significance: float = ...,
    steepness: float = ...,
    widest_kept: float = ...,
    width_step: float = ...,
    stretch: float = ...,
) -> SparseGraph: ...

def build(
    map: Union[OccupancyMap, _Path],
    *,
    progress: _Progress = ...,
    threads: int = ...,
    min_clearance: float = ...,
    unknown: str = ...,
    max_distance: float = ...,
    limits: Optional[FlightLimits] = ...,
    theta: float = ...,
    least_apart: float = ...,
    prune_radius: float = ...,
    split_deviation: float = ...,
    significance: float = ...,
    simplify: bool = ...,
    tangent_pairs: int = ...,
    basis_point_edges: bool = ...,
    paper_diagram: bool = ...,
    **loading: Any,
) -> Roadmap: ...

def load(path: _Path) -> Roadmap: ...

def open_sequence(folder: _Path) -> DepthSequence: ...

def open_scans(folder: _Path) -> ScanSequence: ...

def load_world(path: _Path) -> World: ...

def load_tsdf(path: _Path) -> TsdfMap: ...

def delta_between(before: Roadmap, now: Roadmap) -> GraphDelta: ...

def field_of_view(
    camera: PinholeCamera,
    min_range: float = ...,
    max_range: float = ...,
    share_of_range: float = ...,
) -> Dict[str, Any]: ...
