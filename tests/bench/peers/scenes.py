"""The scenes of the robots (scene.h), and what simulators have to agree in."""
from turns import Worker

SCENES = ["open", "wall", "corner", "crowd"]
OTHER_STEPS = ["Enki, 5 ms"]
COLUMNS = ["Forage", "Enki", "Bullet", "MuJoCo", *OTHER_STEPS]


def program(programs, peer):
    return programs / f"peer_{peer.lower()}_robots"


def workers(scene, programs, peers):
    """All make steps of 1 ms, 80 in a cycle. Enki also makes its usual ones of 5 ms."""
    found = {"Forage": Worker([program(programs, "Forage"), scene])}
    for name in COLUMNS[1:]:
        peer, _, steps = name.partition(",")
        if peer in peers:
            found[name] = Worker([program(programs, peer), scene, *(["16"] if steps else [])])
    return found


def disagreements(scene, workers):
    """What simulators do otherwise than Forage in a minute: sentences, none if they agree. Enki has no friction at walls, and
    a crowd is chaotic, so the bounds are wide: 10 % for the mean of all rays, 25 % for speeds."""
    wrong = []
    expected = None
    for name, worker in workers.items():
        distance, speed, x, y, overlap = worker.ask("check")
        expected = expected or (distance, speed, x, y)
        tests = {
            "what the rays measure": abs(distance / expected[0] - 1) < 0.1,
            "the robots' speed": abs(speed - expected[1]) < 0.25 * max(expected[1], 0.3),
            "overlaps": overlap < 0.005,
        }
        if scene in ("open", "corner"):
            tests["where the robot is"] = abs(x - expected[2]) < 0.05 and abs(y - expected[3]) < 0.05
        wrong += [f"{scene}: {name} differs in {what}" for what, right in tests.items() if not right]
    return wrong
