import { IconAlertTriangle } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTopic } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { kStroke } from '../../parts/icons';
import { useShown } from '../../robot_hooks';
import { text } from '../../text';
import { words } from './words';
import { BusLine } from './hub';
import { NetworkPicture } from './network_picture';
import { NodeTable } from './node_table';
import { LinkTable, TrafficTable } from './traffic_table';
import { useNetwork } from './use_network';
import '../../look/robot.css';

/** Nodes around the bus, who talks to whom, and a table of each with its run control. */
export default function NetworkPanel() {
  const frame = useRef<HTMLDivElement>(null);
  const place = useRef<HTMLDivElement>(null);
  const shown = useShown(frame);
  const robot = useTopic('robot', {});
  const network = useNetwork(shown);
  const area = useArea(frame, place, shown);
  const there = robot !== undefined && robot.kind !== 'none';
  return (
    <div className="network" ref={frame}>
      {robot?.twins.map((twin) => (
        <p key={twin} className="notice" role="status">
          <IconAlertTriangle className="icon" size={14} stroke={kStroke} aria-hidden />
          <span className="ellipsis" title={twin}>
            {twin}
          </span>
        </p>
      ))}
      {!there ? (
        <Quiet>{text.empty.network}</Quiet>
      ) : robot.nodes.length === 0 ? (
        <Quiet>{words.looksFor}</Quiet>
      ) : (
        <div className="network__body">
          <div className="network__view">
            <BusLine robot={robot} />
            <div className="network__picture" ref={place}>
              {area ? <NetworkPicture network={network} area={area} /> : null}
            </div>
          </div>
          <div className="network__tables">
            <NodeTable network={network} />
            <TrafficTable network={network} />
            <LinkTable network={network} />
          </div>
        </div>
      )}
    </div>
  );
}

/** In a panel of so many pixels the tables are beside the picture; robot.css knows it, too. */
const kBeside = 900;

/** The room for the picture; it is drawn for it, so that its text is never scaled. */
function useArea(
  frame: React.RefObject<HTMLElement | null>,
  place: React.RefObject<HTMLElement | null>,
  shown: boolean,
) {
  const [area, setArea] = useState<{ width: number; height: number } | null>(null);
  useEffect(() => {
    const element = place.current;
    if (!element || !shown) return;
    const look = () => {
      const width = element.clientWidth;
      // Above the tables it is as high as it needs; beside them it has their height.
      const beside = (frame.current?.clientWidth ?? 0) >= kBeside;
      const height = beside ? element.clientHeight : 0;
      setArea((before) =>
        before?.width === width && before.height === height ? before : { width, height },
      );
    };
    look();
    const observer = new ResizeObserver(look);
    observer.observe(element);
    return () => observer.disconnect();
  }, [frame, place, shown]);
  return area;
}
