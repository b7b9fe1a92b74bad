"""Checks that the values of the broker's chart give a client what nats.conf gives it, and writes what they make of the
broker's configuration: check_values.py FILE."""

import json
import re
import sys
from pathlib import Path

import yaml

HERE = Path(__file__).parent
# The one of the broker's manual.
KEY = "UDXU4RCSJNZOIQHZNWXHXORDPRTGNJAHAHFRGZNEEJCPQTT2M7NLCNF4"


def main() -> None:
    values = yaml.safe_load((HERE / "kubernetes/nats-values.yaml").read_text())["config"]
    [user] = values["merge"]["authorization"]["users"]
    granted = user["permissions"]
    conf = (HERE / "nats/nats.conf").read_text()
    lists = [re.findall(r'"([^"]+)"', part) for part in re.findall(r"(?:allow|deny): \[(.*?)\]", conf, re.DOTALL)]
    told = [granted["publish"]["allow"], granted["publish"]["deny"], granted["subscribe"]["allow"]]
    if lists != told:
        sys.exit("nats-values.yaml and nats.conf grant different things")
    user["nkey"] = KEY
    configuration = {"jetstream": values["jetstream"]["merge"], **values["merge"]}
    Path(sys.argv[1]).write_text(json.dumps(configuration))


if __name__ == "__main__":
    main()
